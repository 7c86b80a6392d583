"""One robot model, read from SDF or URDF, in which everything knows its place."""
