"""One file a layer: what it shows of a robot."""
