"""Moves of files and folders that a power failure does not undo or leave half done."""

from __future__ import annotations

import os
from pathlib import Path

from checker.base.private_files import make_folder


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
    rename(source, target)
    settle_name(target)


def rename(source: Path, target: Path) -> None:
    """Do the same in no time; a power failure undoes it until `settle_name` has been called."""
    make_folder(target.parent)
    source.rename(target)


def settle_name(target: Path) -> None:
    """Have a name written to the disk, and that of its folder, which may be new."""
    settle(target.parent)
    settle(target.parent.parent)
