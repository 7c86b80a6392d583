"""WLD: the systems that a world loads, and what its models need."""
