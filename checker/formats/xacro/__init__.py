"""Xacro files, expanded in a child process; places stay those of the files that were written."""
