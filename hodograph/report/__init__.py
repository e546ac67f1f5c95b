"""What the reports share: pages, tables, the style of figures, the clock."""
