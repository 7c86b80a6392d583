"""Effects of the actions of a launch file."""
