"""One robot model for all formats, in which every value knows its place in the files."""
