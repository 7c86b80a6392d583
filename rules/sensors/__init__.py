"""SEN: sensors, what they are set to, and where they look."""
