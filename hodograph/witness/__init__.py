"""What the independent witnesses are made of; no file here serves more than one of them."""
