"""Moves of files and folders that a power failure does not undo or leave half done."""

from __future__ import annotations

import os
from pathlib import Path


def settle(path: Path) -> None:
    """Have a file or folder written to the disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def settle_below(folder: Path) -> None:
    """Have a folder written to the disk with all that it holds."""
    for place, _, names in os.walk(folder):
        for name in names:
            settle(Path(place, name))
        settle(Path(place))


def move(source: Path, target: Path) -> None:
    """Give a file or folder, already settled, its final name; folders above are made as needed.

    A file of that name is replaced; a folder is not.

    Raises:
        OSError: A folder of that name holds files, or the names lie on two file systems.
    """
    made = not target.parent.is_dir()
    target.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    source.rename(target)
    settle(target.parent)
    if made:
        settle(target.parent.parent)
