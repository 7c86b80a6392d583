"""What ROS 2 launch files start, in Python, XML and YAML; they are read and never run."""
