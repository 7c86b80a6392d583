"""Findings that the user has seen and set aside, and what became of the wish to do so."""
