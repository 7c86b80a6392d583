"""Mesh files: read in a child process, their facts kept on disk."""
