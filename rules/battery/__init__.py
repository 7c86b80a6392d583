"""BAT: battery, its draining and endurance."""
