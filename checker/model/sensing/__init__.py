"""Settings of cameras, lidars and inertial units, in SI units."""
