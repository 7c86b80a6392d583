"""Layers of a scene, one file for each."""
