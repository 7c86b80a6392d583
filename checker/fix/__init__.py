"""The edits of findings, made in memory: which go together, and the result."""
