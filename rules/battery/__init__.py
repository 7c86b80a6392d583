"""Batteries: that there is one, that it drains, and how long it lasts."""
