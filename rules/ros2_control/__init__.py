"""Hardware and controllers of ros2_control."""
