"""Files that compute: what a spawner emits, what xacro expands to, what launch files start."""
