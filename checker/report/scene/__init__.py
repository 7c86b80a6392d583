"""The robot for display: layers of shapes, and the motion of its links."""
