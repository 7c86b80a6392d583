"""The launch graph: what roslaunch would start, every part with its place."""
