"""The process that reads mesh files: one for all that is wanted of them in a check.

It may be started before it is known which files the robot names: it loads its libraries while its
parent loads its own, which takes each of them half a second.
"""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import islice
from typing import Any, TypeVar

from checker.base.background import Work, work_key
from checker.base.cache import Cache
from checker.base.child_process import Limits
from checker.base.child_server import Server
from checker.base.files import read_bytes
from checker.base.record import Record
from checker.package.index import FileEntry
from checker.package.package import Package
from checker.physics.mesh.trimesh_files import SUFFIXES as TRIMESH_SUFFIXES

_MODULE = f"{__package__}.worker"
SIZE_LIMIT = 100_000_000
"""Bytes of a file; the largest of 129 real ones has 1.9 MB."""
SECONDS_FOR_ONE = 20
"""Processor time for one file."""
SECONDS_FOR_ALL = 90
"""Processor time for the files of one robot; those left then are not read."""
MEMORY = 1_000_000_000
"""Bytes of address space: the libraries take 0.6 GB of it, and a million triangles fit in."""

_LIBRARIES = ("lxml", "numpy", "pycollada", "scipy", "trimesh")
_SUFFIXES = (".dae", ".stl", ".obj", *(f".{suffix}" for suffix in TRIMESH_SUFFIXES))
_LOOKED_AT = 20
"""Files; where none of these is known, the package counts as new."""

T = TypeVar("T")


def _file_of(item: Any) -> Iterable[tuple[str, int]]:
    return [(item["file"], SIZE_LIMIT)]


def mesh_work(
    wanted: str,
    items: Mapping[str, Any],
    decode: Callable[[Any], T],
    lasts: Callable[[T], bool],
    files: Callable[[Any], Iterable[tuple[str, int]]] = _file_of,
    here: Callable[[Any], Any] | None = None,
) -> Work[T]:
    """Return work for the process.

    Args:
        wanted: `facts`, `appearance` or `views` (see `checker.physics.mesh.worker`).
        items: The items, as in `Work`; the same applies to the other arguments.
        decode: Makes a result of an answer.
        lasts: Whether a result is valid next time too.
        files: The files of an item.
        here: Computes one item in this process.
    """
    request = {"wanted": wanted, "seconds": SECONDS_FOR_ONE, "seconds_for_all": SECONDS_FOR_ALL}
    return Work(wanted, _MODULE, _limits(), items, decode, request, files, lasts, here)


class MeshServer(Record, eq=False):
    """Reads the meshes of one check."""

    server: Server


def mesh_server() -> Server:
    """Return what reads meshes, its process not started yet."""
    return Server(_MODULE, _limits())


def _limits() -> Limits:
    return Limits(SECONDS_FOR_ALL, MEMORY)


def facts_key(data: bytes, suffix: str, picked: Sequence[str] = ()) -> str:
    """Return a hash of all that the facts of a mesh depend on.

    Args:
        data: Content of the file.
        suffix: The suffix of its name, with the dot.
        picked: Names of parts that are measured by themselves.
    """
    return work_key([suffix.lower(), *picked, data], ["physics/mesh", "model/mesh.py"], _LIBRARIES)


def are_new(package: Package, cache: Cache) -> bool:
    """Return whether a package contains meshes of which nothing is known.

    One known mesh will do: those that the robot does not name stay unknown for ever.
    """
    files = list(islice(package.index.with_suffix(*_SUFFIXES), _LOOKED_AT))
    return bool(files) and not any(_is_known(file, cache) for file in files)


def _is_known(file: FileEntry, cache: Cache) -> bool:
    data = read_bytes(file.location, file.path, SIZE_LIMIT)
    if not isinstance(data, bytes):
        return False
    return cache.get("facts", facts_key(data, posixpath.splitext(file.path)[1])) is not None
