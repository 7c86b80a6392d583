"""Appearance of mesh files, within a budget of triangles, and notes on those not shown."""

from __future__ import annotations

import hashlib
import posixpath
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import Any, Protocol
from urllib.parse import unquote

from checker.base.background import Background, work_key
from checker.base.files import NotReadable, read_bytes
from checker.base.parts import WorkerFailed
from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.model.mesh import Mesh, MeshFault
from checker.model.robot import Robot
from checker.package.package import Package
from checker.physics.mesh import process
from checker.physics.mesh.obj import MATERIAL_LIMIT
from checker.physics.mesh.package_meshes import PackageMeshes
from checker.physics.mesh.surface import Appearance, Surface, appearance_from_json, shares
from checker.physics.mesh.uris import MeshFile
from checker.source.text import Located

# The sources of meshes' surfaces, and the notes about parts that are not shown.


# What is not shown, as sentences: each once, and not more than anybody reads.


SENTENCES = 20
_NAME = 80
"""Characters of a name in a sentence."""


@dataclass
class Notes:
    """Sentences in the order in which they were first stated."""

    _sentences: dict[str, None] = field(default_factory=dict)

    def say(self, sentence: str) -> None:
        """Add a sentence, unless it was stated."""
        self._sentences[sentence] = None

    @property
    def sentences(self) -> tuple[str, ...]:
        """The first ones, and how many more there are."""
        sentences = tuple(self._sentences)
        if len(sentences) <= SENTENCES:
            return sentences
        rest = len(sentences) - SENTENCES + 1
        return (*sentences[: SENTENCES - 1], f"{rest} more parts are not shown")


def short(name: str) -> str:
    """Return a name that fits in a sentence."""
    return plain(shortened(name, _NAME))


class Surfaces(Protocol):
    """Appearance of the mesh files of a robot."""

    def load(self, uri: Located[str]) -> tuple[Surface, ...] | str:
        """Return what the mesh file behind a URI looks like.

        Metres, with its own unit, the model's `<scale>` not applied. Asked again for the same
        file, it returns the same arrays, so that they are stored once. Else why the file cannot be
        shown: the end of a sentence whose subject is the file.
        """
        ...


class NoSurfaces(Record):
    """For a robot whose mesh files are not read."""

    def load(self, uri: Located[str]) -> tuple[Surface, ...] | str:  # noqa: ARG002 - as a `Surfaces`
        """State that the file was not read."""
        return "was not read"


FOR_ONE = 40_000
"""Triangles of one file."""
FOR_ALL = 150_000
"""Triangles of the files of one robot, each counted once however often it is used."""
PICTURE_LIMIT = 30_000_000
"""Bytes of a picture file."""
_BESIDE = 40
"""Pictures, and material files, of one mesh."""
_LIBRARIES = ("fast-simplification", "lxml", "numpy", "pillow", "pycollada", "trimesh")


class MeshFiles(Record, eq=False, dict=True):
    """Appearance of the mesh files of a robot: a `Surfaces`.

    Attributes:
        meshes: The places and contents of the meshes, and what reads them.
    """

    meshes: PackageMeshes

    def load(self, uri: Located[str]) -> Appearance:
        """Return what the file behind a URI looks like; the first call reads all files."""
        mesh, place = self.meshes.load(uri), self.meshes.content(uri)
        if isinstance(mesh, MeshFault):
            return mesh.reason
        if isinstance(place, MeshFault):
            return place.reason
        key = self._asked[0].get(place[0].path)
        if key is None:
            return "is not a mesh of this robot"
        read = self._appearances.results()[key]
        if isinstance(read, WorkerFailed):
            return f"was not read: its reader {read.reason}"
        return read

    def begin(self) -> None:
        """Begin to read, while the caller does something else; `load` waits for it."""
        self._appearances.begin()

    def stop(self) -> None:
        """Stop the reading if it still runs."""
        if "_appearances" in self.__dict__:
            self._appearances.stop()

    @cached_property
    def _asked(self) -> tuple[Mapping[str, str], Mapping[str, Any]]:
        """Keys of the cache by the paths of files, and the requests by the keys."""
        files: dict[str, tuple[MeshFile, str, Mesh]] = {}
        for uri in self.meshes.uris:
            mesh, place = self.meshes.load(uri), self.meshes.content(uri)
            if isinstance(mesh, Mesh) and isinstance(place, tuple):
                files[place[0].path] = (*place, mesh)
        # Of files with the same content only one is shown.
        counts = {key: min(mesh.triangles, FOR_ONE) for _, key, mesh in files.values()}
        most = dict(zip(counts, shares([*counts.values()], FOR_ALL), strict=True))
        items = {
            path: _asked_of(self.meshes.package, file, key, mesh, most[key])
            for path, (file, key, mesh) in files.items()
        }
        return {path: key for path, (key, _) in items.items()}, dict(items.values())

    @cached_property
    def _appearances(self) -> Background[Appearance]:
        work = process.mesh_work(
            "appearance", self._asked[1], appearance_from_json, _lasts, _files_of
        )
        return Background(work, self.meshes.cache, self.meshes.server)


def surfaces_of(robot: Robot) -> MeshFiles | NoSurfaces:
    """Return what gives the look of the mesh files of a robot."""
    meshes = robot.meshes
    return MeshFiles(meshes) if isinstance(meshes, PackageMeshes) else NoSurfaces()


def _asked_of(
    package: Package, file: MeshFile, key: str, mesh: Mesh, most: int
) -> tuple[str, Mapping[str, Any]]:
    """Return the cache's key of a file's appearance, and the request.

    Args:
        package: The package whose robot names it.
        file: The mesh file.
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
        *(f"{name} {_hash(path, PICTURE_LIMIT)}" for name, path in pictures.items()),
        *(_hash(path, MATERIAL_LIMIT) for path in materials.values()),
    )
    # 0 where all triangles fit into the budget.
    budget = 0 if most >= mesh.triangles else most
    return work_key([key, str(budget), *contents], ["physics/mesh"], _LIBRARIES), request


def _lasts(read: Appearance) -> bool:
    """Return whether a result is permanent: next time there may be more time or memory."""
    return not isinstance(read, str)


def _files_of(item: Mapping[str, Any]) -> Iterator[tuple[str, int]]:
    """Yield the files of a request: paths, and how many bytes each may have."""
    yield item["file"], process.SIZE_LIMIT
    yield from ((path, PICTURE_LIMIT) for path in item["pictures"].values())
    yield from ((path, MATERIAL_LIMIT) for path in item["materials"])


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
