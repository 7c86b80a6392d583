"""MSH: mesh files."""
