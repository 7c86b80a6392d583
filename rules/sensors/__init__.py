"""SEN: sensors, their settings and their views."""
