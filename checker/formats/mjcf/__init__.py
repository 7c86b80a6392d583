"""MJCF, the format of MuJoCo: models with their includes and the files that they name."""
