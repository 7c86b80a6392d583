"""What mesh files look like: triangles by material, coloured by their pictures, few enough."""
