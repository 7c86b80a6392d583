"""A description package of Gazebo 9 made into a package that can be submitted."""
