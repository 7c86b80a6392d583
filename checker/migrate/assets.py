"""Meshes and pictures that the robot uses, in the new package."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from checker.base.cache import NO_CACHE
from checker.base.files import NotReadable
from checker.migrate.source import Source
from checker.model.mesh import Mesh
from checker.physics.mesh.package_meshes import PackageMeshes, mesh_uris
from checker.physics.mesh.uris import MeshFile, file_behind

MESHES, TEXTURES = "meshes", "materials/textures"
_PICTURES = (".png", ".jpg", ".jpeg", ".tga", ".bmp", ".tif", ".tiff", ".gif", ".dds")
_FROM_THE_NET = ("http://", "https://")
_SIZE_LIMIT = 100_000_000
"""Bytes of one file."""
_WHOLE_LIMIT = 1_000_000_000
"""Bytes of all files together."""
_FILES_LIMIT = 2_000
_UNFIT = re.compile(r"[^\w./+-]")
"""Characters that URIs, xacro or shells interpret, such as blanks, `%20` and `${`."""


@dataclass(eq=False)
class Assets:
    """Gives the new URIs of meshes and pictures, and remembers which files that takes.

    Attributes:
        source: The package of the files.
        notes: What could not be taken along, as sentences.
    """

    source: Source
    notes: list[str] = field(default_factory=list)
    _targets: dict[str, str] = field(default_factory=dict)
    """New path by old path, as the source's package lists it."""
    _missing: dict[str, str] = field(default_factory=dict)
    """Path where a file that is not available belongs, by its URI."""
    _folders: dict[str, str] = field(default_factory=dict)
    """Folder of the source by the folder of the new package with its files."""

    def uri(self, written: str) -> str:
        """Return the URI of a mesh or picture relative to the new model.sdf.

        Args:
            written: Its URI in the source.
        """
        if written.startswith(_FROM_THE_NET):
            return written
        folder = posixpath.dirname(self.source.description.file)
        file = file_behind(self.source.package, folder, written)
        name = posixpath.basename(written.rstrip("/")) or "mesh"
        if not isinstance(file, MeshFile):
            wanted = self._free(f"{_folder_for(name)}/{_fit(name)}")
            place = self._missing.setdefault(written, wanted)
            new = posixpath.basename(place)
            renamed = "" if new == name else f" as {new}"
            folder = posixpath.dirname(place)
            self._note(f"{written} {file.reason}: put the file into {folder}/{renamed}")
            return place
        return self._target(file.path)

    def package_uri(self, package: str) -> dict[str, str]:
        """Return the `package://` URI in the new package of each file's old path."""
        return {old: f"package://{package}/{new}" for old, new in self._targets.items()}

    def files(self) -> Iterator[tuple[str, bytes]]:
        """Yield each file to write: its path in the new package and its content."""
        self._with_textures()
        room = _WHOLE_LIMIT
        for old, new in self._targets.items():
            content = self.source.package.read_bytes(old, min(_SIZE_LIMIT, room))
            if isinstance(content, NotReadable):
                self._note(f"{old} {content.reason}: it is not copied")
                continue
            room -= len(content)
            yield new, content

    def _with_textures(self) -> None:
        """Take along the pictures and material files that meshes name; keep their paths."""
        package, robot = self.source.package, self.source.description.robot
        uris = mesh_uris(robot)
        meshes = PackageMeshes(package, uris, NO_CACHE)
        try:
            for mesh in map(meshes.load, uris):
                if isinstance(mesh, Mesh) and mesh.path in self._targets:
                    for named in (*mesh.textures, *mesh.materials):
                        self._add_neighbour(mesh.path, named)
        finally:
            meshes.stop()

    def _add_neighbour(self, mesh: str, named: str) -> None:
        old = posixpath.normpath(posixpath.join(posixpath.dirname(mesh), named))
        new = posixpath.normpath(posixpath.join(posixpath.dirname(self._targets[mesh]), named))
        if old in self._targets or not self.source.package.exists(old):
            return
        if new in self._taken:
            self._note(
                f"{mesh} names {named}, but another file is already called {new}: it is left out"
            )
            return
        if new.startswith(("../", "/")):
            self._note(f"{mesh} names {named}, which is outside the package: it is left out")
        elif len(self._targets) < _FILES_LIMIT:
            self._targets[old] = new

    def _target(self, old: str) -> str:
        if old not in self._targets:
            self._targets[old] = self._free(self._unique_folder(old, _target_path(old)))
        return self._targets[old]

    def _unique_folder(self, old: str, wanted: str) -> str:
        """Keep meshes of different folders apart, for their textures may have the same names."""
        folder, name = posixpath.split(wanted)
        if _folder_for(name) == TEXTURES:
            return wanted
        chosen, number = folder, 2
        while self._folders.setdefault(chosen, posixpath.dirname(old)) != posixpath.dirname(old):
            chosen, number = f"{folder}/{number}", number + 1
        return f"{chosen}/{name}"

    @property
    def _taken(self) -> set[str]:
        return {*self._targets.values(), *self._missing.values()}

    def _free(self, wanted: str) -> str:
        """Return a path that no file has yet: `meshes/a.dae`, `meshes/a_2.dae`."""
        taken = self._taken
        stem, suffix = posixpath.splitext(wanted)
        path, number = wanted, 2
        while path in taken:
            path, number = f"{stem}_{number}{suffix}", number + 1
        return path

    def _note(self, note: str) -> None:
        if note not in self.notes:
            self.notes.append(note)


def _folder_for(name: str) -> str:
    return TEXTURES if name.lower().endswith(_PICTURES) else MESHES


def _target_path(old: str) -> str:
    """Return the new path of a file: the same below meshes/, pictures with pictures."""
    name = posixpath.basename(old)
    if _folder_for(name) == TEXTURES:
        return f"{TEXTURES}/{_fit(name)}"
    _, found, below = f"/{old}".rpartition(f"/{MESHES}/")
    return f"{MESHES}/{_fit(below if found else name)}"


def _fit(path: str) -> str:
    """Return a path that is in URIs, xacro and launch files as it is."""
    return _UNFIT.sub("_", path)
