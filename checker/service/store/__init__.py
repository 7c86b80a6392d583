"""Uploads and reports on disk, by the hash of what they hold."""
