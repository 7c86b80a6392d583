"""SDF 1.4 to 1.12 → robots."""
