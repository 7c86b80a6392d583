"""What an editor offers to write at a caret, though the text may not be well-formed."""
