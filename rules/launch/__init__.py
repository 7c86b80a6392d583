"""LCH: launch files of ROS 2."""
