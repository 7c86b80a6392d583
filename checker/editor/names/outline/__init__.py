"""Symbols of an outline, and the tree of a robot that they form."""
