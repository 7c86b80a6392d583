"""Meshes and pictures that the robot uses, each with its place in the new package."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from dataclasses import dataclass, field

from checker.cache import NO_CACHE
from checker.mesh.package_meshes import PackageMeshes, mesh_uris
from checker.mesh.uris import MeshFile, file_behind
from checker.migrate.source import Source
from checker.model.mesh import Mesh
from checker.package.reading import NotReadable

MESHES, TEXTURES = "meshes", "materials/textures"
_PICTURES = (".png", ".jpg", ".jpeg", ".tga", ".bmp", ".tif", ".tiff", ".gif", ".dds")
_FROM_THE_NET = ("http://", "https://")
_SIZE_LIMIT = 100_000_000
"""Bytes of one file."""
_WHOLE_LIMIT = 1_000_000_000
"""Bytes of all files together."""
_FILES_LIMIT = 2_000


@dataclass(eq=False)
class Assets:
    """Gives the new URIs of meshes and pictures, and remembers which files that takes.

    Attributes:
        source: Whose files they are.
        notes: What could not be taken along, as sentences.
    """

    source: Source
    notes: list[str] = field(default_factory=list)
    _targets: dict[str, str] = field(default_factory=dict)
    """New path by old path, as the source's package lists it."""

    def uri(self, written: str) -> str:
        """Return the URI of a mesh or picture relative to the new model.sdf.

        Args:
            written: Its URI in the source.
        """
        if written.startswith(_FROM_THE_NET):
            return written
        folder = posixpath.dirname(self.source.description.file)
        found = file_behind(self.source.package, folder, written)
        name = posixpath.basename(written.rstrip("/")) or "mesh"
        if not isinstance(found, MeshFile):
            self._note(f"{written} {found.reason}: put the file into {_folder_for(name)}/")
            return f"{_folder_for(name)}/{name}"
        return self._target(found.path)

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
        """Take along the pictures and material files that meshes name, as they lie beside them."""
        package, robot = self.source.package, self.source.description.robot
        uris = mesh_uris(robot)
        meshes = PackageMeshes(package, uris, NO_CACHE)
        try:
            for mesh in map(meshes.of, uris):
                if isinstance(mesh, Mesh) and mesh.path in self._targets:
                    for named in (*mesh.textures, *mesh.materials):
                        self._beside(mesh.path, named)
        finally:
            meshes.stop()

    def _beside(self, mesh: str, named: str) -> None:
        old = posixpath.normpath(posixpath.join(posixpath.dirname(mesh), named))
        new = posixpath.normpath(posixpath.join(posixpath.dirname(self._targets[mesh]), named))
        if old in self._targets or not self.source.package.exists(old):
            return
        if new.startswith(("../", "/")):
            self._note(f"{mesh} names {named}, which would lie outside the package: it is left out")
        elif len(self._targets) < _FILES_LIMIT:
            self._targets[old] = new

    def _target(self, old: str) -> str:
        if old not in self._targets:
            wanted = _wanted(old)
            taken = set(self._targets.values())
            stem, suffix = posixpath.splitext(wanted)
            number = 2
            while wanted in taken:
                wanted, number = f"{stem}_{number}{suffix}", number + 1
            self._targets[old] = wanted
        return self._targets[old]

    def _note(self, note: str) -> None:
        if note not in self.notes:
            self.notes.append(note)


def _folder_for(name: str) -> str:
    return TEXTURES if name.lower().endswith(_PICTURES) else MESHES


def _wanted(old: str) -> str:
    """Return where a file goes: below meshes/ as it lies there now, pictures with pictures."""
    name = posixpath.basename(old)
    if _folder_for(name) == TEXTURES:
        return f"{TEXTURES}/{name}"
    _, found, below = f"/{old}".rpartition(f"/{MESHES}/")
    return f"{MESHES}/{below if found else name}"
