"""REF: meshes, textures and other files that a model names."""
