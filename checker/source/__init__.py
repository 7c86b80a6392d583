"""Text with places: every fact knows the file, line and column it came from."""
