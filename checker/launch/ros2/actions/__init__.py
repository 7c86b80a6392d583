"""What the actions of a launch file do."""
