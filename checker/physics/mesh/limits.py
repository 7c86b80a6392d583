"""What the reading of meshes may take."""

SIZE_LIMIT = 100_000_000
"""Bytes of a file; the largest of 129 real ones has 1.9 MB."""

SECONDS_FOR_ONE = 20
"""Processor time for one file."""

SECONDS_FOR_ALL = 90
"""By the clock, for the files of one robot; those left then are not looked at."""

LATE = f"was not read: the others took {SECONDS_FOR_ALL} s"
"""Why a file was not looked at when the time was over: the end of a sentence."""

MEMORY = 1_000_000_000
"""Bytes of address space: the libraries take 0.6 GB of it, and a million triangles fit in."""
