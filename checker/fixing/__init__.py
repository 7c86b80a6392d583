"""Fixes: edits of findings, made in rounds, shown as a patch or written to disk."""
