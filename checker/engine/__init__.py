"""Runs the rules over the parts of a package."""
