"""Mesh files: read by trimesh in a child process, their facts kept on disk."""
