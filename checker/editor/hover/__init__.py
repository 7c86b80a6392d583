"""Hover texts: information about the thing under the pointer, as Markdown."""
