"""What is asked of the child that reads mesh files: one file, and what lies beside it."""

from __future__ import annotations

import hashlib
import posixpath
from collections.abc import Iterable, Iterator, Mapping
from itertools import islice
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from checker.base.cache import code_hash, key_of
from checker.base.disk_file import NotReadable, read_bytes
from checker.base.record import Record
from checker.base.resources import version_of
from checker.model.mesh import Mesh
from checker.package.package import Package
from checker.physics.mesh.limits import SIZE_LIMIT
from checker.physics.mesh.obj import SIZE_LIMIT as MATERIAL_LIMIT
from checker.physics.mesh.uris import MeshFile
from checker.report.scene.files.painting import FILE_LIMIT

_LIBRARIES = ("fast-simplification", "lxml", "numpy", "pillow", "pycollada", "trimesh")
_BESIDE = 40
"""Pictures, and material files, of one mesh."""


class Asked(Record, eq=False):
    """A file to be read.

    Attributes:
        key: Of the cache: a hash of all that the result depends on.
        request: For the worker.
    """

    key: str
    request: Mapping[str, Any]

    @property
    def files(self) -> Iterator[tuple[str, int]]:
        """What goes with the request: paths, and how many bytes each may have."""
        yield self.request["file"], SIZE_LIMIT
        yield from ((path, FILE_LIMIT) for path in self.request["pictures"].values())
        yield from ((path, MATERIAL_LIMIT) for path in self.request["materials"])


def asked_of(package: Package, file: MeshFile, key: str, mesh: Mesh, most: int) -> Asked:
    """Return what is asked about a file.

    Args:
        package: Whose robot names it.
        file: It.
        key: Hash of its content.
        mesh: What is in it.
        most: Triangles that it may have.
    """
    folder = posixpath.dirname(file.path)
    pictures = dict(_existing(package, folder, mesh.textures))
    materials = dict(_existing(package, folder, mesh.materials))
    request = {
        "file": str(file.location),
        "name": posixpath.basename(file.path),
        "triangles": most,
        "pictures": {name: str(path) for name, path in pictures.items()},
        "materials": [str(path) for path in materials.values()],
    }
    contents = (
        *(f"{name} {_hash(path, FILE_LIMIT)}" for name, path in pictures.items()),
        *(_hash(path, MATERIAL_LIMIT) for path in materials.values()),
    )
    code = code_hash("report/scene/files", "report/scene/surface.py", "physics/mesh")
    own = code, *map(version_of, _LIBRARIES)
    return Asked(key_of(key, str(_bucket(most, mesh)), *contents, *own), request)


def _bucket(most: int, mesh: Mesh) -> int:
    """Return what the cache knows a budget by: 0 where all triangles fit into it."""
    return 0 if most >= mesh.triangles else most


def _existing(package: Package, folder: str, names: Iterable[str]) -> Iterator[tuple[str, Path]]:
    """Yield the files within the workspace that a mesh names, by their names inside."""
    for name in islice(names, _BESIDE):
        written = unquote(name.removeprefix("file://")).replace("\\", "/")
        beside = (name, written, f"../materials/textures/{posixpath.basename(written)}")
        for path in dict.fromkeys(beside):
            entry = package.resolve(posixpath.normpath(posixpath.join(folder, path)))
            if entry is not None and entry.is_file:
                yield name, entry.location
                break


def _hash(path: Path, limit: int) -> str:
    data = read_bytes(path, str(path), limit)
    return "" if isinstance(data, NotReadable) else hashlib.sha256(data).hexdigest()
