"""Launch graphs of ROS 2 launch files in Python, XML and YAML, which are read and never run."""
