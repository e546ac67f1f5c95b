"""What the reports share: pages, tables, versions, figure style, folders, the clock."""
