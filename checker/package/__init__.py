"""Packages as files: opening the input, indexing it, and finding inherited parts."""
