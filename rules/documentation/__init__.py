"""DOC: specifications.md."""
