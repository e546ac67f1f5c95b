"""The explorer: one web page that flies launches exactly, for a class."""
