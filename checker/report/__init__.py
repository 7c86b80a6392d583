"""The report of a check, and what renders it."""
