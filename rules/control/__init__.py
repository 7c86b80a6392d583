"""Control: what ros_control is told about the joints of a URDF package."""
