"""Files that start robots: the spawner of a SubT package, launch files of ROS 1 and ROS 2."""
