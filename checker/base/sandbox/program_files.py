"""The files of this program: all that a process needs besides its input."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

_SYSTEM = (
    *("/usr", "/bin", "/lib", "/lib32", "/lib64", "/nix/store"),
    *("/etc/ld.so.cache", "/etc/ld.so.conf", "/etc/ld.so.conf.d", "/etc/glvnd"),
    *("/etc/localtime", "/etc/drirc", "/sys/devices", "/sys/class/drm", "/sys/dev/char"),
)
"""System files: libraries, and what they read when they are loaded."""
_OF_PREFIX = ("bin", "include", "lib", "lib32", "lib64", "pyvenv.cfg")
"""Files of Python's folder, or of a virtual environment."""
_PARTS = ("checker", "rules", "samples", "subt_check", "subt_check.py", "templates")
"""Files of this program in a folder with others, such as a checkout or site-packages."""
MACHINE = ("/proc/cpuinfo", "/proc/meminfo")
"""Files from which libraries read the number of processors and the memory."""
DEVICES = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom")
SCREENS = ("/dev/dri",)
"""Graphics cards."""


def program_paths() -> list[str]:
    """Return the folders and files that contain this program, its libraries and Python itself.

    They are absolute. Folders that contain the home of the user are left out.
    """
    present = [path for path in _candidates() if path.startswith("/") and os.path.lexists(path)]
    paths = dict.fromkeys((*present, *map(os.path.realpath, present)))
    return [path for path in paths if not _private(path) and not _private(os.path.realpath(path))]


def _candidates() -> Iterator[str]:
    yield from _SYSTEM
    prefixes = {sys.prefix, sys.base_prefix, str(Path(sys.executable).resolve().parent.parent)}
    # Beside these parts of it, a prefix may hold anything: the data of this service, a home.
    yield from (f"{prefix}/{part}" for prefix in sorted(prefixes) for part in _OF_PREFIX)
    root = Path(__file__).parents[3]
    # Installed from source, its folder holds what is no part of it.
    yield from (str(root / name) for name in _PARTS)
    named = [os.environ.get(name, "") for name in ("PYTHONPATH", "LD_LIBRARY_PATH")]
    # The first is the folder that this program was started in: perhaps one with a user's data.
    known = sys.path if sys.flags.safe_path else sys.path[1:]
    folders = (*known, *os.pathsep.join(named).split(os.pathsep))
    yield from (path for path in folders if path and Path(path) != root)


def _private(path: str) -> bool:
    """Return whether a folder contains the home of the user, or is it: no place for libraries."""
    try:
        home = Path.home()
    except RuntimeError:  # a user without a home, as in a container
        return False
    # A service may have none but the root of the system.
    return home != Path(home.anchor) and any(
        folder.is_relative_to(path) for folder in (home, home.resolve())
    )
