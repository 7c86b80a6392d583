"""BRG: bridges between Gazebo and ROS 2."""
