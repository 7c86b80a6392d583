"""What is computed from a robot: meshes, masses, views of sensors, the driven trial."""
