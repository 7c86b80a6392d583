"""Formats of robots and worlds: what a file may say, and how it is read into the model."""
