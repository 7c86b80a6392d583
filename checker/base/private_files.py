"""Files and folders for their owner alone, whatever umask a process is started with."""

from __future__ import annotations

import os
import stat
from contextlib import suppress
from pathlib import Path

UMASK = 0o077
"""Of processes that write what no other user of the machine may read."""


def make_folder(folder: Path) -> None:
    """Make a folder, and those above it that are missing, all for their owner alone.

    `Path.mkdir` would make those above it as the umask says.
    """
    if not folder.is_dir():
        make_folder(folder.parent)
        folder.mkdir(mode=0o700, exist_ok=True)


def tighten_below(place: Path) -> None:
    """Take from all others what a file, or a folder and all that it holds, allows them."""
    tighten(place)
    for folder, folders, names in os.walk(place):
        for name in (*folders, *names):
            tighten(Path(folder, name))


def tighten(path: Path) -> None:
    """Take from all others what a file or folder allows them; a link stays what it is."""
    with suppress(OSError):  # it is gone by now, or somebody else's
        mode = path.lstat().st_mode
        if mode & UMASK and not stat.S_ISLNK(mode):
            path.chmod(stat.S_IMODE(mode) & ~UMASK)
