"""The robot together with launch files: controllers, bridges, topics, transforms."""
