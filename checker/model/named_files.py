"""Files that a model names."""

from __future__ import annotations

from checker.base.record import Record
from checker.model.robot import Robot
from checker.source.text import Located


class NamedFiles(Record, eq=False):
    """Files that a robot names, or a static model of a world.

    Attributes:
        uris: URIs of its meshes and textures; those of material scripts are left out.
        meshes: Those of meshes among them.
        includes: URIs of models that it includes and that are not available.
        unloaded: That no launch file loads it, as a clause, where one loads another; else empty.
    """

    uris: tuple[Located[str], ...]
    meshes: frozenset[Located[str]]
    includes: tuple[Located[str], ...] = ()
    unloaded: str = ""


def files_of(robot: Robot) -> NamedFiles:
    """Return the files that a model names."""
    named = (shape.geometry.uri for shape in robot.shapes())
    meshes = frozenset(uri for uri in named if uri is not None)
    return NamedFiles(robot.file_uris, meshes, robot.unresolved_includes, robot.unloaded)
