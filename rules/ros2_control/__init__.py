"""R2C: ros2_control, its hardware and its controllers."""
