"""URD: URDF and xacro files, in URDF packages and next to SDF models."""
