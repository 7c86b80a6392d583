"""The files of this program: all that a process needs which is handed what it reads."""

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
"""Of the system: libraries, and what they look up when they are loaded."""
_PARTS = ("checker", "rules", "templates", "samples")
"""Of this program, where it lies in a folder with other things."""
MACHINE = ("/proc/cpuinfo", "/proc/meminfo")
"""What libraries ask about processors and memory."""
DEVICES = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom")
SCREENS = ("/dev/dri",)
"""Graphics cards."""


def program_paths() -> list[str]:
    """Return the folders and files that hold this program, its libraries and Python itself."""
    found = [path for path in _candidates() if os.path.lexists(path)]
    return [*dict.fromkeys((*found, *map(os.path.realpath, found)))]


def _candidates() -> Iterator[str]:
    yield from _SYSTEM
    yield from {sys.prefix, sys.base_prefix, str(Path(sys.executable).resolve().parent.parent)}
    root = Path(__file__).parents[2]
    # Installed from source, its folder holds what is no part of it.
    yield from (str(root / name) for name in _PARTS)
    named = [os.environ.get(name, "") for name in ("PYTHONPATH", "LD_LIBRARY_PATH")]
    # The first is the folder that this program was started in: that of somebody's data, perhaps.
    known = sys.path if sys.flags.safe_path else sys.path[1:]
    found = (*known, *os.pathsep.join(named).split(os.pathsep))
    yield from (path for path in found if path and Path(path) != root and not _private(path))


def _private(path: str) -> bool:
    """Say whether a folder holds the home of the user, or is it: no place for libraries."""
    try:
        return Path.home().is_relative_to(path)
    except RuntimeError:  # a user without a home, as in a container
        return False
