"""Uploads and reports on disk, by the hash of their content."""
