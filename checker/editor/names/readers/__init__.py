"""Readers of the names in files, one for each format."""
