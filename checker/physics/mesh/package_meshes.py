"""The meshes of one robot: found in its package, read in a child process, kept on disk."""

from __future__ import annotations

import posixpath
from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import islice
from typing import Any

from msgspec import convert, field
from msgspec.structs import replace

from checker.base.background import Background
from checker.base.cache import NO_CACHE, Cache
from checker.base.child_process import NONSENSE
from checker.base.child_server import Server
from checker.base.extras import PHYSICS
from checker.base.files import NotReadable, read_bytes
from checker.base.output import Stages
from checker.base.parts import WorkerFailed
from checker.base.record import Record
from checker.model.mesh import Mesh, MeshFault, MeshTrouble, picked_part
from checker.model.robot import Robot
from checker.package.package import Package
from checker.physics.mesh import process
from checker.physics.mesh.obj import MATERIAL_LIMIT, textures_in
from checker.physics.mesh.uris import MeshFile, file_behind
from checker.source.text import Located

_MATERIAL_FILES = 20
"""Greatest number for one mesh; they are read again in each check."""
_UNKNOWN = MeshFault(MeshTrouble.NOT_LOOKED_AT, "is not a mesh of this robot")

_Read = Mesh | MeshFault
_Address = tuple[str, str]
"""Folder, and URI as written."""


class PackageMeshes(Record, eq=False, dict=True):
    """Gives the meshes of a robot: a `Meshes`. To read them is a stage of the check.

    Attributes:
        package: The package in which they are searched.
        uris: All that the robot names.
        cache: The cache of results.
        stages: Called with a message when the reading is waited for.
        server: Reads them; None starts a process for them alone.
        picks: Parts of them that the robot uses by themselves.
    """

    package: Package
    uris: tuple[Located[str], ...]
    cache: Cache = NO_CACHE
    stages: Stages = field(default_factory=Stages)
    server: Server | None = None
    picks: tuple[tuple[Located[str], str], ...] = ()

    @property
    def read(self) -> bool:
        """True if they have been requested, so that a second request takes no time."""
        return "_by_address" in self.__dict__ or not self.uris

    def load(self, uri: Located[str]) -> Mesh | MeshFault:
        """Return the content of the file behind a URI; the first call reads all files.

        Raises:
            MissingExtra: There is a file to read, and nothing to read it with.
        """
        if not PHYSICS.is_installed:
            place = self.content(uri)
            if isinstance(place, MeshFault):
                return place
            PHYSICS.require_for("a mesh")
        return self._by_address.get(_address(uri), _UNKNOWN)

    def content(self, uri: Located[str]) -> tuple[MeshFile, str] | MeshFault:
        """Return the file behind a URI and a hash of what is in it, without reading the mesh."""
        place = self._places.get(_address(uri), _UNKNOWN)
        if isinstance(place, MeshFault):
            return place
        key = self._keys[place]
        return key if isinstance(key, MeshFault) else (place, key)

    def load_known(self, uri: Located[str]) -> Mesh | MeshFault | None:
        """Return what is known of a file without reading it; None if nothing is."""
        if "_by_address" in self.__dict__:
            return self._by_address.get(_address(uri), _UNKNOWN)
        content = self.content(uri)
        if isinstance(content, MeshFault):
            return content
        file, key = content
        kept = self.cache.get("facts", key)
        try:
            return None if kept is None else self._placed(key, {key: read_from_json(kept)}, file)
        except NONSENSE:
            return None

    def begin(self) -> None:
        """Begin to read what is not known yet; `load` waits for it."""
        with self.stages.stage("meshes"):
            self._facts.begin()

    def stop(self) -> None:
        """Stop the reading if it still runs."""
        if "_facts" in self.__dict__:
            self._facts.stop()

    @cached_property
    def _places(self) -> Mapping[_Address, MeshFile | MeshFault]:
        """The file behind each URI, or why there is none."""
        return {at: file_behind(self.package, *at) for at in map(_address, self.uris)}

    @cached_property
    def _keys(self) -> Mapping[MeshFile, str | MeshFault]:
        """Each file's key in the cache, or why it has none."""
        files = (place for place in self._places.values() if isinstance(place, MeshFile))
        return {file: _key(file, self._picked(file)) for file in dict.fromkeys(files)}

    def _picked(self, file: MeshFile) -> list[str]:
        """Return the names of the parts of a file that are used by themselves, sorted."""
        picks = ((self._places.get(_address(uri)), part) for uri, part in self.picks)
        return sorted({part for place, part in picks if place == file})

    @cached_property
    def _facts(self) -> Background[_Read]:
        """The reading; one content is read once."""
        items: dict[str, Any] = {}
        for file, key in self._keys.items():
            if isinstance(key, str):
                name = posixpath.basename(file.path)
                item: dict[str, Any] = {"file": str(file.location), "name": name}
                if picked := self._picked(file):
                    item["picked"] = picked
                items.setdefault(key, item)
        work = process.mesh_work("facts", items, read_from_json, _lasts)
        return Background(work, self.cache, self.server)

    @cached_property
    def _by_address(self) -> Mapping[_Address, _Read]:
        """Results of the meshes that were read, by address."""
        noun = "mesh" if len(self.uris) == 1 else "meshes"
        with self.stages.stage("meshes", f"reading {len(self.uris)} {noun}"):
            read = self._facts.results()
            files = {file: self._placed(key, read, file) for file, key in self._keys.items()}
        return {
            at: files[place] if isinstance(place, MeshFile) else place
            for at, place in self._places.items()
        }

    def _placed(
        self, key: str | MeshFault, results: Mapping[str, _Read | WorkerFailed], file: MeshFile
    ) -> _Read:
        """Return what was read as that of a file, with the content of the files next to it."""
        read = key if isinstance(key, MeshFault) else results[key]
        if isinstance(read, WorkerFailed):
            reason = f"was not read: its reader {read.reason}"
            return MeshFault(MeshTrouble.NOT_LOOKED_AT, reason)
        if isinstance(read, MeshFault):
            return read
        folder = posixpath.dirname(file.path)
        textures = list(read.textures)
        paths = (posixpath.normpath(posixpath.join(folder, name)) for name in read.materials)
        for path in islice(dict.fromkeys(paths), _MATERIAL_FILES):
            content = self.package.read_bytes(path, MATERIAL_LIMIT)
            textures += textures_in(content) if isinstance(content, bytes) else ()
        return replace(read, path=file.path, textures=tuple(dict.fromkeys(textures)))


def mesh_uris(robot: Robot) -> tuple[Located[str], ...]:
    """Return the URIs of all meshes that a robot names."""
    shapes = (shape.geometry for shape in robot.shapes())
    uris = (shape.uri for shape in shapes if shape.shape == "mesh")
    return tuple(uri for uri in uris if uri is not None and uri.stated and uri.value)


def picked_parts(robot: Robot) -> tuple[tuple[Located[str], str], ...]:
    """Return the parts of meshes that a robot uses by themselves, each with the mesh's URI."""
    shapes = (shape.geometry for shape in robot.shapes())
    meshes = (shape for shape in shapes if shape.shape == "mesh")
    picked = ((shape.uri, picked_part(shape)) for shape in meshes)
    return tuple((uri, part[0]) for uri, part in picked if uri is not None and part and part[0])


def _address(uri: Located[str]) -> _Address:
    return Robot.folder_of(uri), uri.value


def _key(file: MeshFile, picked: Sequence[str]) -> str | MeshFault:
    """Return the cache's key of a file: a hash of all that its mesh depends on."""
    data = read_bytes(file.location, file.path, process.SIZE_LIMIT)
    if isinstance(data, NotReadable):
        return MeshFault(MeshTrouble.NOT_LOOKED_AT, data.reason)
    return process.facts_key(data, posixpath.splitext(file.path)[1], picked)


def _lasts(read: _Read) -> bool:
    """Return whether a result is permanent: at another time there may be more memory."""
    return isinstance(read, Mesh) or read.trouble is not MeshTrouble.NOT_LOOKED_AT


def read_from_json(data: Any) -> _Read:
    """Return the content of a file, as the process that reads it states it.

    Raises:
        KeyError, TypeError, ValidationError: It is something else.
    """
    return convert(data["fault"], MeshFault) if "fault" in data else convert(data["mesh"], Mesh)
