"""ros2_control of one robot: its `<ros2_control>` tags and its controllers."""
