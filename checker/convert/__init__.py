"""The robot in other formats: URDF, SDF and MJCF written anew from the model."""
