"""Walls that the kernel keeps around processes that read strangers' files."""
