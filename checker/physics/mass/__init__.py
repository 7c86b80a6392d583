"""A robot on the scales: mass, inertia and balance, by Pinocchio."""
