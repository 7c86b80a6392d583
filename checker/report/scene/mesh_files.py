"""What the mesh files of a robot look like: thinned out to a budget, read in a child process."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import cached_property

from checker.base.cache import Cache
from checker.base.child_process import Child
from checker.base.record import Record
from checker.base.sandbox.files import from_disk
from checker.model.mesh import Mesh, MeshFault
from checker.model.robot import Robot
from checker.physics.mesh.package_meshes import PackageMeshes, mesh_uris
from checker.physics.mesh.reading_child import all_read
from checker.physics.mesh.uris import MeshFile
from checker.report.scene.early import looks
from checker.report.scene.files.request import Asked, asked_of
from checker.report.scene.files.thinning import shares
from checker.report.scene.files.wire import Looked, from_json, to_json
from checker.source.text import Located

FOR_ONE = 40_000
"""Triangles of one file."""
FOR_ALL = 150_000
"""Triangles of the files of one robot, each counted once however often it is used."""
_KIND = "surfaces"


class _Reading(Record, eq=False):
    """What is known already, by key, and a child that reads the rest, in this order."""

    known: Mapping[str, Looked]
    unread: Sequence[str]
    child: Child | None


class MeshFiles(Record, eq=False, dict=True):
    """Gives what the mesh files of a robot look like: a `Surfaces`.

    Attributes:
        meshes: Where they are found, and what is in them.
        uris: All that the robot names.
        cache: Where results are kept.
        waiting: A child that waits for files to read.
    """

    meshes: PackageMeshes
    uris: tuple[Located[str], ...]
    cache: Cache
    waiting: Child | None = None

    def of(self, uri: Located[str]) -> Looked:
        """Return what the file behind a URI looks like; the first call reads all files."""
        mesh, place = self.meshes.of(uri), self.meshes.content(uri)
        if isinstance(mesh, MeshFault):
            return mesh.reason
        if isinstance(place, MeshFault):
            return place.reason
        asked = self._asked.get(place[0].path)
        return "is no mesh of this robot" if asked is None else self._looked[asked.key]

    def begin(self) -> None:
        """Begin to read, while the caller does something else; `of` waits for it."""
        _ = self._reading

    def stop(self) -> None:
        """End the reading, if nobody has waited for it."""
        if "_reading" in self.__dict__ and self._reading.child is not None:
            self._reading.child.stop()

    @cached_property
    def _asked(self) -> dict[str, Asked]:
        """What is asked, by the path of the file."""
        files: dict[str, tuple[MeshFile, str, Mesh]] = {}
        for uri in self.uris:
            mesh, place = self.meshes.of(uri), self.meshes.content(uri)
            if isinstance(mesh, Mesh) and isinstance(place, tuple):
                files[place[0].path] = (*place, mesh)
        # Of files with the same content only one is shown.
        counts = {key: min(mesh.triangles, FOR_ONE) for _, key, mesh in files.values()}
        most = dict(zip(counts, shares([*counts.values()], FOR_ALL), strict=True))
        return {
            path: asked_of(self.meshes.package, file, key, mesh, most[key])
            for path, (file, key, mesh) in files.items()
        }

    @cached_property
    def _reading(self) -> _Reading:
        asked = {each.key: each for each in self._asked.values()}
        known = {key: found for key in asked if (found := self._known(key)) is not None}
        unread = [key for key in asked if key not in known]
        if not unread:
            return _Reading(known, (), None)
        child = self.waiting or looks()
        request = json.dumps([asked[key].request for key in unread]).encode()
        files = dict(file for key in unread for file in asked[key].files)
        child.give(request, from_disk(files.items()))
        return _Reading(known, unread, child)

    @cached_property
    def _looked(self) -> dict[str, Looked]:
        """Wait for the child, and keep what it has read."""
        reading = self._reading
        if reading.child is None:
            return dict(reading.known)
        read = dict(zip(reading.unread, _answered(reading.child, len(reading.unread)), strict=True))
        for key, looked in read.items():
            # What could not be read may be next time: it may have more time or memory.
            if not isinstance(looked, str):
                self.cache.put(_KIND, key, to_json(looked))
        return {**reading.known, **read}

    def _known(self, key: str) -> Looked | None:
        try:
            return from_json(self.cache.get(_KIND, key))
        except ValueError:
            return None


def surfaces_of(
    meshes: PackageMeshes, robot: Robot, cache: Cache, waiting: Child | None = None
) -> MeshFiles:
    """Return what gives the looks of a robot's mesh files.

    Args:
        meshes: Those of the robot.
        robot: Its visuals and collisions are shown.
        cache: Where results are kept.
        waiting: A child that waits for files to read.
    """
    return MeshFiles(meshes, mesh_uris(robot), cache, waiting)


def _answered(child: Child, number: int) -> list[Looked]:
    """Wait for what a child has read, as many files as it was given."""
    read = all_read(child, number, from_json)
    return [read] * number if isinstance(read, str) else read
