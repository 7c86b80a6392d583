"""CTL: ros_control in URDF packages."""
