"""Models of MuJoCo as MuJoCo itself compiles them, and what they do in its first second."""
