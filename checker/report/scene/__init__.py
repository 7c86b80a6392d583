"""The robot as those who look at it see it: layers of shapes, and how its links move."""
