"""URDF → robots."""
