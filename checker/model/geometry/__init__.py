"""Shapes in space: transforms, boxes, convex shapes."""
