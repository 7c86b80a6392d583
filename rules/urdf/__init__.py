"""URD: URDF and xacro files, of packages that are made of them and beside SDF models."""
