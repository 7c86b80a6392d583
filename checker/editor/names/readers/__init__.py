"""What each file writes of names, one reader a format."""
