"""A driven wheel, track or heavy body without collision, or a robot without any.

A link without collision touches nothing: a wheel turns in the air or sinks into the ground, a body
drives through walls, and a robot without collisions falls through the world. It is an info in a
URDF that no launch file of the workspace gives to a simulator, since RViz needs no collision, and
in what is fixed to the world, such as a camera that looks at the robot. A robot without collisions
weighs less where launch files give it to ros2_control of hardware alone. No accepted package that
we checked has this fault.

Fix: give the part a `<collision>`: a wheel a cylinder, a track boxes and cylinders, a body a simple
shape around it.
Source: SDFormat specification: only `<collision>` elements make contacts.
"""

from collections.abc import Iterator

from checker.base.record import Record
from checker.model.components import Link, Plugin
from checker.model.robot import Robot
from checker.ros.spawned_files import SpawnedFiles
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Severity,
    finding,
    lessened,
    rule,
    unchecked,
)
from checker.source.text import Located


@rule("GEO002", "part-without-collision", Severity.ERROR, Concern.ROBOT)
def check(
    robot: Robot, context: Context, spawned: SpawnedFiles | None, *, body_share: float = 0.25
) -> Findings:
    """Report wheels and tracks without collision; a warning for wheels that nothing drives.

    Options:
        body_share: Share of the robot's mass; links that are fixed together, weigh more, have
            visuals and have no collision are a warning.
    """
    if robot.is_static:
        return
    if robot.missing_parts or robot.unread_plugins:
        yield unchecked(robot.missing_parts or robot.unread_plugins)
    if robot.links and not any(link.collisions for link in robot.links):
        if not robot.missing_parts:
            found = _without_any(robot, context)
            clause = spawned.of_hardware(robot) if spawned is not None else ""
            yield lessened(found, clause) if clause and not robot.shown_only else found
        return
    for part in _driven(robot):
        if not any(link.collisions for link in part.links):
            yield finding(
                part.links[0],
                f"{part.kind} {part.links[0].name.value!r} has no collision",
                severity=Severity.INFO if robot.shown_only else None,
                related=[(part.by, "the plugin that drives it")],
            )
    yield from _others(robot)
    if robot.unknown_masses:
        yield unchecked(robot.unweighed)
    else:
        yield from _bodies(robot, body_share * robot.mass)


def _without_any(robot: Robot, context: Context) -> Finding:
    what = "no link of the robot has a collision"
    if robot.conventions.has_massless_links and not robot.mass:
        message = f"{what}, and none has a mass: the model is only visible"
        return finding(robot, message, severity=Severity.INFO)
    if robot.shown_only:
        return finding(robot, f"{what}: {robot.shown_only}", severity=Severity.INFO)
    if robot.is_fixture:
        message = f"{what}; it is fixed to the world, so that it does not fall"
        return finding(robot, message, severity=Severity.INFO)
    if robot.drives or (robot.stands_alone and context.is_subt):
        return finding(robot, f"{what}: the robot falls through the ground")
    is_object = robot.is_prop and robot.conventions.read_by_gazebo
    alone = len(robot.links) == 1 and context.is_gazebo_sim
    return finding(
        robot,
        f"{what}: nothing touches the robot",
        severity=Severity.INFO if alone or is_object else Severity.WARNING,
    )


def _warning(robot: Robot) -> Severity:
    return Severity.INFO if robot.shown_only else Severity.WARNING


def _bodies(robot: Robot, least_mass: float) -> Iterator[Finding]:
    of_wheels = {link.scoped_name for part in _driven(robot) for link in part.links}
    for body in robot.tree.rigid_bodies.links.values():
        links = [robot.tree.links[name] for name in body if name not in of_wheels]
        mass = sum(link.mass for link in links)
        seen = [link for link in links if link.visuals]
        if seen and mass > least_mass and not any(link.collisions for link in links):
            yield finding(
                seen[0],
                f"{seen[0].name.value!r} of {mass:.3g} kg has a visual, but no collision",
                severity=_warning(robot),
            )


class _Part(Record, eq=False):
    kind: str
    links: tuple[Link, ...]
    by: Plugin | Located[str]


def _driven(robot: Robot) -> Iterator[_Part]:
    for wheel in robot.locomotion.wheels:
        yield _Part("wheel", wheel.body, wheel.name)
    for track in robot.locomotion.tracks:
        yield _Part("track", (track.link,), track.plugin)


def _others(robot: Robot) -> Iterator[Finding]:
    driven = {link.scoped_name for part in _driven(robot) for link in part.links}
    fixed = {it.scope + it.child.value for it in robot.joints if it.type.value == "fixed"}
    for link in robot.wheels if robot.locomotion.wheel_drives else ():
        is_frame = link.scoped_name in fixed and not link.visuals
        if link.scoped_name not in driven and not link.collisions and not is_frame:
            yield finding(
                link,
                f"wheel {link.name.value!r} has no collision, and no plugin drives it",
                severity=_warning(robot),
            )


def _rover(wheel: str, mark: str = "", body: str = "<collision name='c'/>") -> str:
    return f"""
<link name="body">{body}</link>
<link name="wheel">{mark}
  {wheel}
</link>
<joint name="axle" type="revolute">
  <parent>body</parent>
  <child>wheel</child>
  <axis><xyz>0 1 0</xyz></axis>
</joint>
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">
  <left_joint>axle</left_joint>
</plugin>
"""


_ROUND = (
    "<collision name='c'><geometry><cylinder><radius>0.1</radius><length>0.1</length></cylinder>"
    "</geometry></collision>"
)
_TYRE = f"""
<link name="tyre">{_ROUND}</link>
<joint name="rim" type="fixed"><parent>wheel</parent><child>tyre</child></joint>
"""
_TRACK = """
<plugin filename="libp.so" name="ignition::gazebo::systems::TrackController">
  <link>left_track</link>
</plugin>
"""

_FRAME = """
<link name="wheel_base"/>
<joint name="bracket" type="fixed"><parent>body</parent><child>wheel_base</child></joint>
"""
GOOD = [_rover(_ROUND), _rover("") + _TYRE, _rover(_ROUND) + _FRAME]
BAD = [
    _rover("<visual name='v'/>", "  <!-- ^ GEO002 -->"),
    """
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">  <!-- ^ GEO002 -->
<link name="base_link"><visual name="v"/></link>
</model>
</sdf>
""",
    f"""
<link name="left_track"/>  <!-- ^ GEO002 -->
<link name="body">{_ROUND}</link>
{_TRACK}
""",
    f"""
<link name="body"><visual name="v"/></link>  <!-- ^ GEO002 -->
<link name="bumper">{_ROUND}</link>
<joint name="spring" type="prismatic"><parent>body</parent><child>bumper</child></joint>
""",
    f"""
<link name="rear_wheel"/>  <!-- ^ GEO002 -->
{_rover(_ROUND)}
""",
]
