"""ROS: launch files, bridges and topics."""
