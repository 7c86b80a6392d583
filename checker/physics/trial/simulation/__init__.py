"""The robot driven in MuJoCo, in a child process."""
