"""One robot model for all formats, in which every value has its place in the files."""
