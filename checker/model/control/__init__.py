"""Control of a URDF package: its launch files, their parameters, and the robot, put together."""
