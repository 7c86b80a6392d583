"""Nested models and includes made into one flat model, by text edits that mean the same."""
