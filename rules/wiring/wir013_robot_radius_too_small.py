"""A costmap of Nav2 whose robot_radius is less than the robot's base.

Paths are planned as if the robot were a circle with this radius around its base frame. If the base
reaches beyond the circle on all sides, it hits obstacles beside these paths. Often the value is
copied from the parameters of a smaller robot.

It is reported for a costmap without `footprint` where the launch file has one
robot_state_publisher, and its robot is known. A launch file without one is started beside the
others of the package: there the radius is reported if it is too small for the robots of all. The
base is the link of `robot_base_frame`, or one that is fixed to it, by the box around its
collisions; a base that the circle reaches beyond on one side is not reported.

Fix: write half the diagonal of the base, which the message names, or its `footprint`.
Source: navigation2, nav2_costmap_2d: `footprint`, `robot_radius`, `robot_base_frame`.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

from checker.model.geometry.boxes import Box
from checker.model.robot import Robot
from checker.ros.wiring.frames import STATE_PUBLISHER
from checker.ros.wiring.inputs import costmap_of
from checker.ros.wiring.parameters import Setting
from checker.ros.wiring.wiring import Wiring, Wirings
from checker.rule import Concern, Findings, Severity, finding, rule

_NONE = ("", "[]")


@rule("WIR013", "robot-radius-too-small", Severity.WARNING, Concern.INTERFACE)
def check(wirings: Wirings, *, part: float = 0.95) -> Findings:
    """Report a `robot_radius` of a costmap that is less than the base of the robot.

    Options:
        part: Radius of a costmap divided by that of the largest circle around the base frame that
            is within the base; less is reported.
    """
    for wiring in wirings.all:
        publishers = _publishers(wiring)
        robots = _robots((wiring,) if publishers else wirings.all)
        if publishers > 1 or not robots:
            continue
        for node in wiring.nodes:
            name, settings = costmap_of(node)
            radius, footprint = settings.get("robot_radius"), settings.get("footprint")
            if radius is None or (footprint is not None and footprint.text not in _NONE):
                continue
            value, (inner, outer, link) = radius.value, _least_base(robots, _base_frame(settings))
            if isinstance(value, int | float) and value < part * inner:
                yield finding(
                    radius.span,
                    f"robot_radius of {name} is {value:g} m, but link {link!r} reaches {inner:.3g} "
                    f"m or more to each side: expected {math.ceil(100 * outer) / 100:g} m, "
                    "around it",
                )


def _publishers(wiring: Wiring) -> int:
    return sum(node.program == STATE_PUBLISHER for node in wiring.every_node)


def _robots(wirings: Sequence[Wiring]) -> list[Robot]:
    """Return the robots whose transforms launch files publish; none if one is not known."""
    known = all(_publishers(each) == len(each.described) for each in wirings)
    return [robot for each in wirings for _, robot in each.described] if known else []


def _least_base(robots: Sequence[Robot], frame: str) -> tuple[float, float, str]:
    """Return the circles within and around the base of the smallest robot, and its link."""
    return min(max(_bases(robot, frame), default=(0.0, 0.0, "")) for robot in robots)


def _base_frame(settings: Mapping[str, Setting]) -> str:
    stated = settings.get("robot_base_frame")
    return "base_link" if stated is None else stated.text or ""


def _bases(robot: Robot, frame: str) -> Iterator[tuple[float, float, str]]:
    """Yield the links fixed to a frame: the circles within and around each, and its name."""
    pose, body = robot.pose_of(frame), robot.tree.rigid_bodies.of_link
    for name, link in robot.tree.links.items() if pose is not None else ():
        box = robot.box_of(link, visuals_too=False)
        if box is not None and pose is not None and body[name] == body.get(frame):
            x, y, _ = pose.translation
            yield *_radii(box, x, y), name


def _radii(box: Box, x: float, y: float) -> tuple[float, float]:
    """Return the radii of the circles around a point: one within a box, one around it."""
    along_x, along_y = ((box.high[i] - at, at - box.low[i]) for i, at in enumerate((x, y)))
    return min(*along_x, *along_y), math.hypot(max(along_x), max(along_y))


_LAUNCHED = "LaunchDescription([\n"
_SERVER = """
        Node(package="nav2_controller", executable="controller_server",
             parameters=[os.path.join(HERE, "config", "nav2.yaml")]),
"""
_URDF = """<robot name="rover">
  <link name="base_footprint"/>
  <link name="chassis">
    <collision>
      <origin xyz="{} 0 0.2"/><geometry><box size="0.8 0.5 0.2"/></geometry>
    </collision>
  </link>
  <joint name="mount" type="{}">
    <parent link="base_footprint"/><child link="chassis"/><axis xyz="0 0 1"/>
  </joint>
</robot>
"""


def _example(
    radius: str, x: float = 0.0, joint: str = "fixed", more: str = ""
) -> dict[str, object]:
    yaml = "local_costmap:\n  local_costmap:\n    ros__parameters:\n"
    yaml += f"      robot_base_frame: base_footprint\n      robot_radius: {radius}\n{more}"
    return {
        "@bridge": True,
        "@launch": {_LAUNCHED: _LAUNCHED + _SERVER},
        "urdf/rover.urdf": _URDF.format(x, joint),
        "config/nav2.yaml": yaml,
    }


_NAVIGATION = """import os
from launch import LaunchDescription
from launch_ros.actions import Node

HERE = os.path.join(os.path.dirname(__file__), "..")


def generate_launch_description():
    return LaunchDescription(["""


def _launched_apart(radius: str) -> dict[str, object]:
    """Return the same with the nodes of Nav2 in a launch file of their own."""
    launch = {"launch/navigation.launch.py": f"{_NAVIGATION}{_SERVER}])\n"}
    return {name: it for name, it in _example(radius).items() if name != "@launch"} | launch


GOOD = [
    _example("0.25"),
    _example("0.1", x=0.32),
    _example("0.1", joint="continuous"),
    _launched_apart("0.25"),
    _example("0.1", more='      footprint: "[[0.4, 0.25], [0.4, -0.25], [-0.4, 0.0]]"\n'),
]
BAD = [
    _example("0.2  # ^ WIR013"),
    _example("0.1  # ^ WIR013", x=0.2),
    _launched_apart("0.2  # ^ WIR013"),
]
