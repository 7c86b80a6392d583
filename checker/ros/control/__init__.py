"""Controllers of ROS 1: launch files of a URDF package, their parameters, and the robot."""
