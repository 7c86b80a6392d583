"""Uploads: the form, the index of an archive, and the order of a check."""
