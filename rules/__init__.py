"""The rule book: one rule, one file; the folder is its group."""
