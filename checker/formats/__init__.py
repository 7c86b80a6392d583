"""Formats of robots and worlds: the content of files, and how it is read into the model."""
