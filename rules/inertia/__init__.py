"""INE: mass and inertia."""
