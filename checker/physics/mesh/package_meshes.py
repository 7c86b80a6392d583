"""The meshes of one robot: found in its package, read in a child process, kept on disk."""

from __future__ import annotations

import json
import posixpath
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice

from msgspec.structs import replace

from checker.base.cache import NO_CACHE, Cache
from checker.base.child_process import Child, Limits
from checker.base.disk_file import NotReadable, read_bytes
from checker.base.progress import Stages
from checker.base.record import Record
from checker.base.sandbox.files import from_disk
from checker.model.mesh import Mesh, MeshFault, MeshTrouble
from checker.model.robot import Robot
from checker.package.package import Package
from checker.physics.mesh.key import KIND, mesh_key
from checker.physics.mesh.limits import (
    MEMORY,
    SECONDS_FOR_ALL,
    SECONDS_FOR_ONE,
    SIZE_LIMIT,
)
from checker.physics.mesh.obj import SIZE_LIMIT as MATERIAL_LIMIT
from checker.physics.mesh.obj import textures_in
from checker.physics.mesh.reading_child import all_read
from checker.physics.mesh.uris import MeshFile, file_behind
from checker.physics.mesh.wire import from_json, to_json
from checker.source.text import Located

_MATERIAL_FILES = 20
"""Of one mesh; they are read anew in each check."""
_UNKNOWN = MeshFault(MeshTrouble.NOT_LOOKED_AT, "is no mesh of this robot")

_Read = Mesh | MeshFault


class _Reading(Record, eq=False):
    """Meshes that are known, and a child that reads the others.

    Attributes:
        places: The file, or why there is none, by folder and URI as written.
        keys: Each file's key in the cache, or why it has none.
        known: By key.
        unread: Keys of what the child reads, in its order.
        child: None when there is nothing to read.
    """

    places: Mapping[tuple[str, str], MeshFile | MeshFault]
    keys: Sequence[tuple[MeshFile, str | MeshFault]]
    known: Mapping[str, _Read]
    unread: Sequence[str]
    child: Child | None


class PackageMeshes(Record, eq=False, dict=True):
    """Gives the meshes of a robot: a `Meshes`.

    Attributes:
        package: Where they are looked for.
        uris: All that the robot names.
        cache: Where results are kept.
        waiting: A child that was started before it was known what to read.
    """

    package: Package
    uris: tuple[Located[str], ...]
    cache: Cache = NO_CACHE
    waiting: Child | None = None

    def of(self, uri: Located[str]) -> Mesh | MeshFault:
        """Return what the file behind a URI holds; the first call reads all files."""
        return self._by_address.get(_address(uri), _UNKNOWN)

    def content(self, uri: Located[str]) -> tuple[MeshFile, str] | MeshFault:
        """Return the file behind a URI and a hash of what is in it, without reading the mesh."""
        place = self._reading.places.get(_address(uri), _UNKNOWN)
        if isinstance(place, MeshFault):
            return place
        key = self._content_keys[place.path]
        return key if isinstance(key, MeshFault) else (place, key)

    def begin(self) -> None:
        """Begin to read what is not known yet; `of` waits for it."""
        _ = self._reading

    def stop(self) -> None:
        """End the reading, if nobody has waited for it."""
        if "_reading" in self.__dict__ and self._reading.child is not None:
            self._reading.child.stop()

    @cached_property
    def _by_address(self) -> dict[tuple[str, str], _Read]:
        """What is known, by folder and URI as written."""
        reading = self._reading
        read = {**reading.known, **self._now(reading)}
        files = {
            file.path: key if isinstance(key, MeshFault) else self._placed(read[key], file)
            for file, key in reading.keys
        }
        return {
            at: files[place.path] if isinstance(place, MeshFile) else place
            for at, place in reading.places.items()
        }

    @cached_property
    def _content_keys(self) -> dict[str, str | MeshFault]:
        return {file.path: key for file, key in self._reading.keys}

    @cached_property
    def _reading(self) -> _Reading:
        """What is known already, and the child that reads the rest; one content is read once."""
        places = {at: file_behind(self.package, *at) for at in map(_address, self.uris)}
        files = {place.path: place for place in places.values() if isinstance(place, MeshFile)}
        keys = [(file, _key(file)) for file in files.values()]
        known: dict[str, _Read] = {}
        unread: dict[str, MeshFile] = {}
        for file, key in keys:
            if isinstance(key, str) and key not in known and key not in unread:
                found = _known(self.cache, key)
                if found is None:
                    unread[key] = file
                else:
                    known[key] = found
        child = _started([*unread.values()], self.waiting) if unread else None
        return _Reading(places, keys, known, [*unread], child)

    def _now(self, reading: _Reading) -> dict[str, _Read]:
        """Wait for the child, and keep what holds next time as well."""
        if reading.child is None:
            return {}
        read = dict(zip(reading.unread, _answered(reading.child, len(reading.unread)), strict=True))
        for key, found in read.items():
            # Another day, or another machine, may have the time or the memory.
            if isinstance(found, Mesh) or found.trouble is not MeshTrouble.NOT_LOOKED_AT:
                self.cache.put(KIND, key, to_json(found))
        return read

    def _placed(self, read: _Read, file: MeshFile) -> _Read:
        """Return what was read as that of a file, with what the files beside it say."""
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


def _address(uri: Located[str]) -> tuple[str, str]:
    return Robot.folder_of(uri), uri.value


def _key(file: MeshFile) -> str | MeshFault:
    """Return the cache's key of a file: a hash of all that its mesh depends on."""
    data = read_bytes(file.location, file.path, SIZE_LIMIT)
    if isinstance(data, NotReadable):
        return MeshFault(MeshTrouble.NOT_LOOKED_AT, data.reason)
    return mesh_key(data, posixpath.splitext(file.path)[1])


def _known(cache: Cache, key: str) -> _Read | None:
    try:
        return from_json(cache.get(KIND, key))
    except ValueError:
        return None


def _started(files: list[MeshFile], waiting: Child | None) -> Child:
    """Have a child process read files: the one that waits for them, else a new one."""
    named = [(str(file.location), posixpath.basename(file.path)) for file in files]
    request = json.dumps({"files": named, "seconds": SECONDS_FOR_ONE}).encode()
    child = waiting or Child("checker.physics.mesh.worker", None, Limits(SECONDS_FOR_ALL, MEMORY))
    child.give(request, from_disk((at, SIZE_LIMIT) for at, _ in named))
    return child


def _answered(child: Child, number: int) -> list[_Read]:
    """Wait for what a child has read, as many files as it was given."""
    read = all_read(child, number, from_json)
    return [MeshFault(MeshTrouble.NOT_LOOKED_AT, read)] * number if isinstance(read, str) else read


@dataclass(eq=False)
class TimedMeshes:
    """The meshes of a robot, whose first reading is a stage: a `Meshes`.

    Attributes:
        meshes: Where they are had from.
        number: How many there are.
        read: Whether they have been asked for, so that asking again costs nothing.
    """

    meshes: PackageMeshes
    number: int
    stages: Stages
    read: bool = False

    def begin(self) -> None:
        """Begin to read them, while the caller does something else."""
        with self.stages.stage("meshes"):
            self.meshes.begin()

    def stop(self) -> None:
        """End the reading, if nobody has waited for it."""
        self.meshes.stop()

    def of(self, uri: Located[str]) -> Mesh | MeshFault:
        """Return what the file behind a URI holds."""
        if self.read:
            return self.meshes.of(uri)
        self.read = True
        noun = "mesh" if self.number == 1 else "meshes"
        with self.stages.stage("meshes", f"reading {self.number} {noun}"):
            return self.meshes.of(uri)
