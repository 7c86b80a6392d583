"""What a robot's own visuals hide from its cameras and lidars."""
