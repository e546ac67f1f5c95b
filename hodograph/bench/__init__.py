"""What each way to an answer costs and how far it is off."""
