"""What a mesh file holds, by its suffix; runs in a child process only (see `worker`)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from importlib import import_module

from checker.mesh.dae import read_dae
from checker.mesh.measure import measure
from checker.mesh.obj import read_obj
from checker.mesh.stl import read_stl
from checker.mesh.surface import NoSurface, Surface
from checker.model.mesh import Mesh, MeshFault, MeshTrouble

_Reader = Callable[[bytes], Surface]
_READERS: dict[str, _Reader] = {"dae": read_dae, "stl": read_stl, "obj": read_obj}

_LIBRARIES = {"dae": "collada", "obj": "trimesh"}
"""What reads a format, by the suffix of its files."""

_POINTER = b"version https://git-lfs"


def load_libraries(names: Iterable[str]) -> None:
    """Import once what reads files of these names, before a process forks to read them."""
    suffixes = {name.rpartition(".")[2].lower() for name in names}
    for suffix, library in _LIBRARIES.items():
        if suffix in suffixes:
            import_module(library)


def read_mesh(data: bytes, path: str) -> Mesh | MeshFault:
    """Return what a file holds.

    Args:
        data: Its content.
        path: Its name; the suffix decides on the format, as in Gazebo.
    """
    suffix = path.rpartition(".")[2].lower()
    try:
        return measure(read_surface(data, path), path, suffix)
    except NoSurface as none:
        return MeshFault(none.trouble, none.reason)


def read_surface(data: bytes, path: str) -> Surface:
    """Return the triangles of a file.

    Raises:
        NoSurface: It cannot be read.
    """
    suffix = path.rpartition(".")[2].lower()
    reader = _READERS.get(suffix)
    if reader is None:
        reason = f"has a format that the checker does not read: .{suffix}"
        raise NoSurface(reason, MeshTrouble.UNSUPPORTED)
    if not data.strip():
        raise NoSurface("is empty")
    if data.startswith(_POINTER):
        raise NoSurface("is a Git LFS pointer, not the mesh")
    return _surface(reader, data)


def _surface(reader: _Reader, data: bytes) -> Surface:
    """Read a file whose every line may be wrong.

    Raises:
        NoSurface: It cannot be read.
    """
    try:
        return reader(data)
    except (NoSurface, MemoryError):
        raise
    except RecursionError:
        raise NoSurface("is nested too deeply", MeshTrouble.NOT_LOOKED_AT) from None
    except Exception as error:  # libraries raise anything on corrupt files
        said = str(error).strip().partition("\n")[0][:200]
        raise NoSurface(f"is corrupt: {said or type(error).__name__}") from error
