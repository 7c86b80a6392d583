"""WIR: what the nodes of a ROS 2 launch are to one another."""
