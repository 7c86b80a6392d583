"""Files that a model names."""

from __future__ import annotations

from checker.base.record import Record
from checker.model.components import Visual
from checker.model.robot import Robot
from checker.source.text import Located


class NamedFiles(Record, eq=False):
    """Files that a robot names, a static model of a world, or the world itself.

    Attributes:
        uris: URIs of its meshes and textures; those of material scripts are left out.
        meshes: Those of meshes among them without which it does not work; of scenery, those of
            collisions: Gazebo reports one that is only seen, and runs.
        includes: URIs of models that it includes, and of files of models that a world only names,
            where the model is not available.
        unloaded: That no launch file loads it, as a clause, where one loads another; else empty.
    """

    uris: tuple[Located[str], ...]
    meshes: frozenset[Located[str]]
    includes: tuple[Located[str], ...] = ()
    unloaded: str = ""


def files_of(robot: Robot, *, in_world: bool = False) -> NamedFiles:
    """Return the files that a model names.

    Args:
        robot: The model.
        in_world: Whether it is one of a world, where what only lies there is scenery.
    """
    is_scenery = in_world and not (robot.joints or robot.sensors or robot.all_plugins)
    named = [(it, uri) for it in robot.shapes() if (uri := it.geometry.uri) is not None]
    touching = {uri.value for shape, uri in named if not isinstance(shape, Visual)}
    meshes = frozenset(uri for _, uri in named if not is_scenery or uri.value in touching)
    return NamedFiles(robot.file_uris, meshes, robot.unresolved_includes, robot.unloaded)
