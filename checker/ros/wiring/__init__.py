"""One ROS 2 launch as a graph: nodes, their parameters, topics and transforms."""
