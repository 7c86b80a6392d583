"""A robot as a scene of MuJoCo."""
