"""A world without ground, in which the robot falls.

No static model of the world has a collision: a floor, a plane, a terrain. A `<visual>` alone does
not support the robot. Worlds without gravity, with buoyancy, or with models that are not available
are not reported, nor are robots that are fixed to the world.

Fix: add a static model with a `<plane>` as its collision.
Source: gravity, and gz-sim, which adds no ground to a world of the user's own.
"""

from collections.abc import Iterator

from checker.base.record import Record
from checker.model.plugin_library import is_of_gazebo, library_stem
from checker.model.robot import Robot
from checker.model.tree import WORLD
from checker.model.world import World, holds
from checker.ros.simulation import Simulations
from checker.rule import Concern, Context, Findings, Severity, Where, finding, rule

_LIFTS = ("buoyancy", "hydrodynamics")
_OTHER_PARTS = ("population", "road")
"""Other elements that may hold something up, besides models."""


class _Falling(Record, eq=False):
    """A world and a robot that is put into it."""

    world: World
    robot: Robot
    places: tuple[tuple[Where, str], ...]


@rule("WLD011", "no-ground", Severity.WARNING, Concern.ROBOT)
def check(simulations: Simulations | None, world: World | None, context: Context) -> Findings:
    """Report worlds without anything to stand on, each with the first robot that falls."""
    seen: set[World] = set()
    for each in _placed_robots(simulations, world):
        if each.world not in seen and _falls(each, context.release):
            seen.add(each.world)
            yield finding(
                each.world,
                f"{each.robot.name.value!r} falls for ever: no static model of world "
                f"{each.world.name!r} has a <collision>",
                related=each.places,
                key=each.world.name,
            )


def _placed_robots(simulations: Simulations | None, world: World | None) -> Iterator[_Falling]:
    if world is not None:
        yield from (_Falling(world, model, ()) for model in world.models)
    for simulation in simulations.launched if simulations is not None else ():
        if simulation.unknown_robots or any(_stands(each.robot) for each in simulation.robots):
            continue
        for spawned in simulation.robots:
            for loaded in simulation.worlds:
                yield _Falling(loaded, spawned.robot, ((spawned.node, "spawned here"),))


def _falls(each: _Falling, release: str) -> bool:
    return not (
        each.robot.is_static
        or each.robot.missing_parts
        or _hangs(each.robot)
        or _holds(each.world, release)
    )


def _holds(world: World, release: str) -> bool:
    """Return whether a world contains something that holds robots up, or may do so."""
    weightless = not any(world.gravity)
    foreign = any(not is_of_gazebo(library_stem(it.filename.value)) for it in world.plugins)
    lifted = any(holds(world.all_systems(release), system) for system in _LIFTS)
    others = any(world.element.child(tag) is not None for tag in _OTHER_PARTS)
    unread = world.unknown or any(model.missing_parts for model in world.models)
    return bool(
        weightless or foreign or lifted or others or unread or any(map(_stands, world.models))
    )


def _stands(model: Robot) -> bool:
    """Return whether a model is fixed and can be touched."""
    fixed = (link for link in model.links if model.is_static or model.is_still(link))
    return any(link.collisions for link in fixed) or (_hangs(model) and not model.is_static)


def _hangs(robot: Robot) -> bool:
    """Return whether it is fixed to the world."""
    return any(tie.parent == WORLD for tie in robot.tree.ties)


def _world(content: str, mark: str = "", more: str = "") -> str:
    return f"""
<sdf version="1.9">
  <world name="hall">{mark}
    {more}
    <model name="floor">{content}</model>
    <model name="box"><link name="body"/></model>
  </world>
</sdf>
"""


_PLANE = "<geometry><plane><size>9 9</size></plane></geometry>"
_FLOOR = f"""<static>true</static><link name="l"><collision name="c">{_PLANE}</collision></link>"""
_PICTURE = f"""<static>true</static><link name="l"><visual name="v">{_PLANE}</visual></link>"""


def _example(floor: str, mark: str = "") -> dict[str, object]:
    world = f"""<sdf version="1.9">
  <world name="hall">{mark}
    <model name="floor">{floor}</model>
  </world>
</sdf>
"""
    gazebo = '("gz_args", ["-r ", os.path.join(HERE, "worlds", "hall.sdf")])'
    changes = {'("gz_args", "-r empty.sdf")': gazebo}
    return {"@bridge": True, "@profile": "ros2", "@launch": changes, "worlds/hall.sdf": world}


_MARK = "  <!-- ^ WLD011 -->"
GOOD = [
    _world(_FLOOR),
    _world(_PICTURE, more="<gravity>0 0 0</gravity>"),
    _world(_PICTURE, more="<include><uri>https://fuel.example/depot</uri></include>"),
    _world(_PICTURE, more='<plugin filename="acme-terrain" name="acme::Terrain"/>'),
    _example(_FLOOR),
]
BAD = [_world(_PICTURE, _MARK), _example(_PICTURE, _MARK)]
