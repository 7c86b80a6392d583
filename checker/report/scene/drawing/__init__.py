"""Pictures of a robot, drawn by MuJoCo in a child process without a window."""
