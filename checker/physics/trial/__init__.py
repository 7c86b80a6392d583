"""The driven trial: a robot on a course in MuJoCo, and the measurements."""
