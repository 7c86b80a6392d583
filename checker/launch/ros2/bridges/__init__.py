"""Bridges of ros_gz: what passes between ROS and Gazebo."""
