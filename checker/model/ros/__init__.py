"""The robot's side of ROS: bridges, topics, transforms."""
