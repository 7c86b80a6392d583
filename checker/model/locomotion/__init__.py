"""Locomotion of a robot: wheels, tracks, rotors, and the plugins that drive them."""
