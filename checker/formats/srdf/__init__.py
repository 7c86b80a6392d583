"""SRDF: groups, poses and collision pairs of a robot, for MoveIt."""
