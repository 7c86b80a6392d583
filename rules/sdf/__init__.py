"""SDF: syntax and schema."""
