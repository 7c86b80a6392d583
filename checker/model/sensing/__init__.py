"""What cameras, lidars and inertial units are set to, in SI units."""
