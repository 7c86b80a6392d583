"""A robot on wheels that a fixed joint to the world holds in place.

The link `world` is the ground of a simulator: what a fixed joint connects to it never moves. The
wheels of such a robot turn, and the robot stays. The joint is usually left from the description of
an arm, or was meant for RViz, which shows the robot without it too.

Meant are robots with two wheels or more that turn about level axes and reach down to the lowest
part of the robot. Wheels are those that a drive turns, links that are called wheels, and round
links at the end of the tree that turn by a whole turn.

It is an error if a launch file gives the robot to a simulator, else a warning.

Fix: remove the joint and the link `world`. RViz and navigation use the odometry, `odom` → base, in
their place.
Source: the conversion of URDF to SDF in sdformat and Gazebo Classic, where a fixed joint to `world`
fixes the robot.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from checker.base.words import and_list
from checker.model.geometry.placed_shapes import union
from checker.model.locomotion.locomotion import Side, Wheel
from checker.model.locomotion.wheels import WheelReader, perpendicular_directions, tread
from checker.model.robot import Robot
from checker.model.tree import WORLD, Tie
from checker.package.package import Package
from checker.ros.simulation import Simulations
from checker.rule import Concern, Findings, Severity, finding, rule

_FEWEST = 2
_LEVEL = 0.5
"""Cosine of the angle between an axle and the vertical, at most."""
_WHOLE_TURN = 6.2
"""Radians; 0 to 6.28 is meant as a whole turn."""
_ROUND = 0.9
"""Least reach of a wheel across its axle, as a share of its largest."""
_NEAR_GROUND = 0.02
"""Metres between the lowest points of a wheel and of the robot, at most."""
_ROS_1_SPAWN = "spawn_model"


@rule("KIN022", "rover-fixed-to-world", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, package: Package, simulations: Simulations | None) -> Findings:
    """Report the fixed joints that connect robots with wheels on the ground to the world."""
    held = [it for it in robot.tree.ties if it.parent == WORLD and it.joint.type.value == "fixed"]
    if not held or robot.is_static:
        return
    spawned = simulations.given(robot) if simulations is not None else []
    if spawned and not any(it.tree.links_fixed_to_world for it in spawned):
        return
    wheels = sorted(repr(wheel.link.name.value) for wheel in _wheels_on_ground(robot))
    if len(wheels) < _FEWEST:
        return
    ros_1 = _ROS_1_SPAWN in package.workspace.launch_words and not robot.shown_only
    for tie in held:
        yield finding(
            tie.joint,
            f"the robot cannot drive in a simulator: fixed joint {tie.joint.name.value!r} holds "
            f"{tie.child!r} at the world, and its wheels {and_list(wheels)} are on the "
            f"ground; remove the joint",
            severity=Severity.ERROR if spawned or ros_1 else None,
        )


def _wheels_on_ground(robot: Robot) -> Iterator[Wheel]:
    whole = union([box for link in robot.links if (box := robot.box_of(link)) is not None])
    if whole is None:
        return
    reader = WheelReader(robot)
    called = {link.scoped_name for link in robot.wheels}
    inner = {tie.parent for tie in robot.tree.ties if tie.joint.type.value != "fixed"}
    for tie in robot.tree.ties:
        if not _turns_wholly(tie):
            continue
        wheel = reader.wheel_below(tie.joint, Side.LEFT, {})
        if wheel is None or wheel.centre is None or wheel.axis is None or wheel.radius is None:
            continue
        rolls = tie.child in called or (tie.child not in inner and _is_round(robot, wheel))
        low = wheel.centre[2] - wheel.radius <= whole.low[2] + _NEAR_GROUND
        if rolls and low and abs(wheel.axis[2]) <= _LEVEL:
            yield wheel


def _turns_wholly(tie: Tie) -> bool:
    joint = tie.joint
    if joint.type.value not in ("continuous", "revolute") or len(joint.axes) != 1:
        return False
    limits = joint.axes[0]
    range_of_motion = limits.upper.value - limits.lower.value
    return joint.type.value == "continuous" or range_of_motion >= _WHOLE_TURN


def _is_round(robot: Robot, wheel: Wheel) -> bool:
    """Return whether the largest collision of a link reaches equally far around its axle."""
    rolls, axis, centre = tread(robot, wheel), wheel.axis, wheel.centre
    if rolls is None or axis is None or centre is None:
        return False
    reaches = []
    for direction in perpendicular_directions(axis):
        far = robot.support_of(rolls.shape.geometry, rolls.pose, direction)
        if far is None:
            return False
        reaches.append(far - sum(a * b for a, b in zip(direction, centre, strict=True)))
    return min(reaches) >= _ROUND * max(reaches)


_WHEEL = """  <link name="{name}">
    <collision><origin rpy="1.5708 0 0"/><geometry>{shape}</geometry></collision>
  </link>
  <joint name="{name}_axle" type="{type}">
    <parent link="base_link"/><child link="{name}"/><origin xyz="{x} {y} {z}"/>
    <axis xyz="0 1 0"/><limit lower="0" upper="{upper}" effort="5" velocity="9"/>
  </joint>
"""
_ROUND_SHAPE = '<cylinder radius="0.1" length="0.04"/>'
_WORLD = """  <link name="world"/>
  <joint name="hold" type="{type}">{mark}
    <parent link="world"/><child link="base_link"/>
  </joint>
"""


def _rover(mark: str = "", **more: Any) -> str:
    """Return the URDF of a robot with two round links, fixed to the world."""
    values = {
        "name": "wheel",
        "shape": _ROUND_SHAPE,
        "type": "continuous",
        "z": 0.1,
        "upper": 6.28,
        "hold": "fixed",
    } | more
    wheels = "".join(
        _WHEEL.format(**values | {"name": f"{values['name']}_{x}{y}", "x": x, "y": y})
        for x, y in ((0, 1), (0, -1))
    )
    return f"""<robot name="rover">
{_WORLD.format(type=values["hold"], mark=mark)}
  <link name="base_link">
    <collision><origin xyz="0 0 0.2"/><geometry><box size="0.6 0.4 0.2"/></geometry></collision>
  </link>
{wheels}
  <gazebo/>
</robot>
"""


def _alone(mark: str = "", **more: Any) -> dict[str, object]:
    return {"@urdf": True, "@profile": "gazebo-harmonic", "urdf/rover.urdf": _rover(mark, **more)}


def _launched(severity: str = "", **more: Any) -> dict[str, object]:
    mark = f"  <!-- ^ KIN022 {severity} -->" if severity else ""
    return {"@bridge": True, "urdf/rover.urdf": _rover(mark, **more)}


_MARK = "  <!-- ^ KIN022 -->"
GOOD = [
    _alone(hold="floating"),
    _alone(z=0.4),
    _alone(name="roller", shape='<box size="0.1 0.2 0.04"/>'),
    _alone(name="roller", type="revolute", upper=3.14),
    _launched(hold="floating"),
]
BAD = [
    _alone(_MARK),
    _alone(_MARK, name="LW", type="revolute"),
    _launched("error"),
]
