"""Parts of the views of cameras and lidars that the robot's own visuals hide."""
