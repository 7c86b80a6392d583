"""Another name for a thing: the edits, and all reasons against them."""
