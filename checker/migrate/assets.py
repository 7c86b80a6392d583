"""Meshes and pictures that the robot uses, in the new package, and pictures drawn of it."""

from __future__ import annotations

import base64
import json
import posixpath
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from checker.base.cache import NO_CACHE
from checker.base.child_process import NONSENSE, Limits, ask, from_json
from checker.base.files import NotReadable
from checker.base.parts import WorkerFailed
from checker.base.record import Record
from checker.base.sandbox.files import from_disk
from checker.migrate.source import Source
from checker.model.components import Visual
from checker.model.mesh import Mesh
from checker.model.robot import Robot
from checker.physics.mesh.package_meshes import PackageMeshes, mesh_uris
from checker.physics.mesh.process import SIZE_LIMIT
from checker.physics.mesh.uris import MeshFile, file_behind
from checker.physics.trial.mjcf.names import quaternion

# Pictures of the robot from five sides, by MuJoCo in a child process, where OpenGL is there.


NAMES = ("1", "2", "3", "4", "5")
"""Slantwise, from above, from the left, from the front, from the rear."""
SHAPES = ("box", "sphere", "cylinder", "capsule", "mesh")
_GREY = (0.6, 0.6, 0.6, 1.0)
_SECONDS, _MEMORY = 60.0, 16_000_000_000
"""Of processor time, and bytes of address space: software renderers map far more than they use."""


class Thumbnails(Record):
    """Pictures, or why there are none.

    Attributes:
        files: PNG files by their name without suffix.
        trouble: What the author has to do instead; empty when they were drawn.
    """

    files: Mapping[str, bytes] = {}
    trouble: str = ""


def thumbnails_of(robot: Robot, folder: Path) -> Thumbnails:
    """Draw a robot.

    Args:
        robot: To draw.
        folder: Of its package, to which the URIs of its meshes are relative.
    """
    shapes = list(_shapes(robot, folder))
    if not shapes:
        return Thumbnails(trouble=_trouble("the model has no visuals"))
    request = json.dumps({"shapes": shapes}).encode()
    files = dict.fromkeys((str(shape["file"]) for shape in shapes if shape["file"]), SIZE_LIMIT)
    limits = Limits(_SECONDS, _MEMORY, draws=True)
    data = ask(f"{__package__}.thumbnail_worker", request, limits, from_disk(files.items()))
    if isinstance(data, WorkerFailed):
        return Thumbnails(trouble=_trouble(f"the process that draws {data.reason}"))
    try:
        answer = from_json(data)
        if "pictures" not in answer:
            return Thumbnails(trouble=_trouble(str(answer.get("unable", "there is no picture"))))
        pictures = (base64.b64decode(picture) for picture in answer["pictures"])
        return Thumbnails(dict(zip(NAMES, pictures, strict=True)))
    except NONSENSE:
        return Thumbnails(trouble=_trouble("the process that draws sent an invalid answer"))


def _trouble(reason: str) -> str:
    return f"thumbnails/1.png to 5.png (at an angle, top, left, front, rear), not drawn: {reason}"


def _shapes(robot: Robot, folder: Path) -> Iterator[dict[str, Any]]:
    for link in robot.links:
        for visual in link.visuals:
            pose = robot.pose_of_part(link, visual.pose)
            shape = visual.geometry.shape
            if pose is None or shape not in SHAPES:
                continue
            file = _file(visual, folder) if shape == "mesh" else ""
            if shape == "mesh" and not file:
                continue
            yield {
                "shape": shape,
                "sizes": {
                    name: [value.value for value in values]
                    for name, values in visual.geometry.sizes.items()
                },
                "file": file,
                "position": pose.translation,
                "quaternion": quaternion(pose.rotation),
                "colour": _colour(visual),
            }


def _file(visual: Visual, folder: Path) -> str:
    """Return where a mesh lies on disk; empty for one that the package does not hold."""
    uri = visual.geometry.uri
    path = posixpath.normpath(uri.value) if uri is not None else ""
    if not path or path.startswith(("/", "../")) or "://" in path:
        return ""
    real = folder / path
    return str(real.resolve()) if real.is_file() else ""


def _colour(visual: Visual) -> list[float]:
    colour = visual.material.colours.get("diffuse", ()) if visual.material is not None else ()
    values = [min(max(number.value, 0.0), 1.0) for number in colour[:4]]
    return [*values, *_GREY[len(values) :]]


MESHES, TEXTURES = "meshes", "materials/textures"
_PICTURES = (".png", ".jpg", ".jpeg", ".tga", ".bmp", ".tif", ".tiff", ".gif", ".dds")
_FROM_THE_NET = ("http://", "https://")
_SIZE_LIMIT = 100_000_000
"""Bytes of one file."""
_WHOLE_LIMIT = 1_000_000_000
"""Bytes of all files together."""
_FILES_LIMIT = 2_000
_UNFIT = re.compile(r"[^\w./+-]")
"""What URIs, xacro or shells read in their own way, such as blanks, `%20` and `${`."""


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
    _missing: dict[str, str] = field(default_factory=dict)
    """Path where a file that is not available belongs, by its URI."""
    _folders: dict[str, str] = field(default_factory=dict)
    """Folder of the source by the folder of the new package that holds its files."""

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
            self._targets[old] = self._free(self._apart(old, _wanted(old)))
        return self._targets[old]

    def _apart(self, old: str, wanted: str) -> str:
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


def _wanted(old: str) -> str:
    """Return where a file goes: below meshes/ as it lies there now, pictures with pictures."""
    name = posixpath.basename(old)
    if _folder_for(name) == TEXTURES:
        return f"{TEXTURES}/{_fit(name)}"
    _, found, below = f"/{old}".rpartition(f"/{MESHES}/")
    return f"{MESHES}/{_fit(below if found else name)}"


def _fit(path: str) -> str:
    """Return a path that stands in URIs, xacro and launch files as it is."""
    return _UNFIT.sub("_", path)
