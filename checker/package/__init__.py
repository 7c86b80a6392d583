"""Packages as files: opening what the user gives, indexing it, and finding inherited parts."""
