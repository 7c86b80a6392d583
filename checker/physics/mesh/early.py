"""Starts the child that reads meshes before it is known which ones the robot names.

It loads its libraries while the parent loads its own: about half a second of a first check.
"""

from __future__ import annotations

import posixpath
from collections.abc import Callable
from itertools import islice

from checker.base.cache import Cache
from checker.base.child_process import Child, Limits
from checker.base.disk_file import read_bytes
from checker.package.index import FileEntry
from checker.package.package import Package
from checker.physics.mesh.key import KIND, mesh_key
from checker.physics.mesh.limits import MEMORY, SECONDS_FOR_ALL, SIZE_LIMIT

_SUFFIXES = (".dae", ".stl", ".obj")
_LOOKED_AT = 20
"""Files; where none of these is known, the package is taken for one that is new."""


def mesh_child() -> Child:
    """Start a child that waits for meshes to read."""
    return Child("checker.physics.mesh.worker", None, Limits(SECONDS_FOR_ALL, MEMORY))


def early_child(
    package: Package, cache: Cache, start: Callable[[], Child] | None = None
) -> Child | None:
    """Start the child if nothing is known of the meshes that a package holds; else return None.

    One known mesh will do: those that the robot does not name stay unknown for ever.

    Args:
        package: Holds the meshes.
        cache: Where known ones are kept.
        start: Starts a child, or has one waiting; `mesh_child` when None.
    """
    files = list(islice(package.index.with_suffix(*_SUFFIXES), _LOOKED_AT))
    if not files or any(_is_known(file, cache) for file in files):
        return None
    return (start or mesh_child)()


def _is_known(file: FileEntry, cache: Cache) -> bool:
    data = read_bytes(file.location, file.path, SIZE_LIMIT)
    if not isinstance(data, bytes):
        return False
    return cache.get(KIND, mesh_key(data, posixpath.splitext(file.path)[1])) is not None
