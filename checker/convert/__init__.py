"""The robot in other formats: URDF, SDF and MJCF written from the model."""
