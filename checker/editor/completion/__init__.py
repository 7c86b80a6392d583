"""Completions at the caret of an editor, even while the text is not well-formed."""
