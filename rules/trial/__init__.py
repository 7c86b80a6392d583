"""TRI: the trial drive in MuJoCo."""
