"""ros2_control of one robot: its `<ros2_control>` tags, its controllers, and what is known of both."""
