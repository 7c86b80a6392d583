"""Reader of mesh files by their suffix; runs in a child process only (see `worker`)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.model.mesh import Mesh, MeshFault, MeshTrouble
from checker.physics.mesh.content import MeshContent, NoSurface, Piece
from checker.physics.mesh.dae import read_dae
from checker.physics.mesh.measure import measure
from checker.physics.mesh.obj import read_obj
from checker.physics.mesh.trimesh_files import SUFFIXES as TRIMESH_SUFFIXES
from checker.physics.mesh.trimesh_files import read_with_trimesh
from checker.source.binary_headers import LFS_POINTER

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray


# Triangles of an STL file, binary or as text; its numbers are taken as metres, as Gazebo does.


_HEADER, _TRIANGLE = 84, 50
"""Bytes: 80 of any text and the count; a normal, three corners (4-byte numbers), 2 more bytes."""

_VERTEX = re.compile(rb"^[ \t]*vertex[ \t]+(\S+)[ \t]+(\S+)[ \t]+(\S+)", re.I | re.M)
_SOLID = re.compile(rb"^[ \t]*solid[ \t]+(\S[^\r\n]{0,200})", re.I | re.M)
_END = re.compile(rb"^[ \t]*endsolid\b", re.I | re.M)


def read_stl(data: bytes, _materials: Iterable[bytes] = ()) -> MeshContent:
    """Return the triangles.

    Many binary files start with `solid` as text files do, so the length decides first.

    Raises:
        NoSurface: The file is cut off, or neither kind of STL.
    """
    count = int.from_bytes(data[80:_HEADER], "little")
    if len(data) >= _HEADER and len(data) == _HEADER + count * _TRIANGLE:
        return MeshContent((Piece(_binary(data, count)),))
    if data.lstrip()[:5].lower() == b"solid" and b"\0" not in data:
        return _text(data)
    if len(data) < _HEADER:
        raise NoSurface(
            f"is not an STL file: it has {len(data)} bytes, but the header alone has 84"
        )
    held = (len(data) - _HEADER) // _TRIANGLE
    if held < count:
        raise NoSurface(
            f"is cut off: it declares {count:,} triangles, but its {len(data):,} bytes contain "
            f"{held:,}"
        )
    left = len(data) - _HEADER - count * _TRIANGLE
    defects = (f"{left:,} bytes follow its last triangle",)
    return MeshContent((Piece(_binary(data, count)),), defects=defects)


def _binary(data: bytes, count: int) -> NDArray[float64]:
    import numpy as np

    numbers = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    triangles = np.frombuffer(data, numbers, count, _HEADER)
    return np.asarray(triangles["corners"], np.float64)


def _text(data: bytes) -> MeshContent:
    import numpy as np

    numbers = _VERTEX.findall(data)
    if len(numbers) % 3:
        raise NoSurface(f"is cut off: it has {len(numbers):,} corners, not 3 for each triangle")
    try:
        corners = np.array(numbers, np.float64).reshape(-1, 3, 3)
    except ValueError as error:
        raise NoSurface(f"contains a corner that is not a number: {error}") from None
    names = [name.decode("utf-8", "replace").strip() for name in _SOLID.findall(data)]
    defects = () if _END.search(data) else ("it does not end in `endsolid`",)
    return MeshContent((Piece(corners),), defects=defects, parts=tuple(dict.fromkeys(names)))


_Reader = Callable[[bytes, Iterable[bytes]], MeshContent]
_READERS: dict[str, _Reader] = {
    "dae": read_dae,
    "stl": read_stl,
    "obj": read_obj,
    **{suffix: partial(read_with_trimesh, suffix=suffix) for suffix in TRIMESH_SUFFIXES},
}


_OF_PROGRAMS = (TypeError, AttributeError, NameError, AssertionError, NotImplementedError)
"""Errors that a program makes, whatever is in the file: they do not show that it is corrupt."""


def load_libraries(names: Iterable[str]) -> None:
    """Import once what reads files of these names, before a process forks to read them."""
    suffixes = {name.rpartition(".")[2].lower() for name in names}
    if "dae" in suffixes:
        import_module("collada")
    if not suffixes.isdisjoint(TRIMESH_SUFFIXES):
        import_module("trimesh")


def read_mesh(data: bytes, path: str, picked: Sequence[str] = ()) -> Mesh | MeshFault:
    """Return the content of a file.

    Args:
        data: Its content.
        path: Its name; the suffix decides on the format, as in Gazebo.
        picked: Names of parts to measure separately, where the file has them.
    """
    suffix = path.rpartition(".")[2].lower()
    try:
        content = read_content(data, path)
        mesh = measure(content, path, suffix)
    except NoSurface as none:
        return MeshFault(none.trouble, none.reason)
    named = {piece.part for piece in content.pieces} & set(picked) - {""}
    picks = {part: measure(content.only(part), path, suffix) for part in sorted(named)}
    return replace(mesh, picks=picks)


def read_content(data: bytes, path: str, material_files: Iterable[bytes] = ()) -> MeshContent:
    """Return the triangles of a file.

    Args:
        data: Its content.
        path: Its name; the suffix decides on the format, as in Gazebo.
        material_files: What is in those that it names, as far as they are available.

    Raises:
        NoSurface: It cannot be read.
    """
    suffix = path.rpartition(".")[2].lower()
    reader = _READERS.get(suffix)
    if reader is None:
        reason = f"has a format that the checker does not read: .{suffix}"
        if "." not in path.rpartition("/")[2]:
            reason = "has no suffix that says which format it has"
        raise NoSurface(reason, MeshTrouble.UNSUPPORTED)
    if not data.strip():
        raise NoSurface("is empty")
    if data.startswith(LFS_POINTER):
        raise NoSurface("is a Git LFS pointer, not the mesh", MeshTrouble.POINTER)
    # Its every line may be wrong.
    try:
        return reader(data, material_files)
    except (NoSurface, MemoryError):
        raise
    except RecursionError:
        raise NoSurface("is nested too deeply", MeshTrouble.NOT_LOOKED_AT) from None
    except Exception as error:  # libraries raise anything on corrupt files
        words = str(error).strip().partition("\n")[0][:200]
        if isinstance(error, _OF_PROGRAMS):
            reason = f"is not read: its reader failed ({type(error).__name__}: {words})"
            raise NoSurface(reason, MeshTrouble.NOT_LOOKED_AT) from error
        raise NoSurface(f"is corrupt: {words or type(error).__name__}") from error
