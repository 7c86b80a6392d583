"""Gazebo gets a robot with its wheels in the ground.

The ground pushes the wheels out. Gazebo Classic throws the robot into the air; Gazebo Sim lifts it
slowly, and a caster that stays below holds the robot at an angle, so that a lidar looks at the
ground. Without `-z`, the origin of the robot is put at z = 0, and many robots have it at the height
of the axles.

Only robots with wheels whose size is known are compared, and those that nothing fixes to the world.
The ground is at z = 0; worlds with a heightmap are left out, and so are heights other than 0 where
the world is not known: a floor may be there.

Fix: give the spawning node the height that the message names, with `-z`.
Source: ros_gz_sim, `create`; gazebo_ros, `spawn_entity.py`;
ros-navigation/nav2_minimal_turtlebot_simulation#33.
"""

import math
from collections.abc import Iterable, Iterator

from checker.launch.ros2.graph import Node
from checker.model.components import Link
from checker.model.robot import Robot
from checker.model.tree import WORLD
from checker.model.world import World
from checker.ros.simulation import Simulation
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import Span

_OPTION = "-z"
_LEVEL = 1e-3
"""Metres within which a plane is at z = 0."""
_FREE = 0.01
"""Metres that a robot starts above the ground in the advice."""


@rule("WIR031", "spawned-in-ground", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring, *, deepest: float = 0.02) -> Findings:
    """Compare the height of spawned robots with the lowest point of their wheels.

    Options:
        deepest: Metres that wheels may start below the ground; more is reported.
    """
    simulation = wiring.simulation
    if simulation is None or any(map(_is_hilly, simulation.worlds)):
        return
    for spawned in wiring.spawned:
        place = _height(spawned.node) if spawned.node.starts else None
        reach = _reach_of_wheels(spawned.robot)
        if place is None or reach is None:
            continue
        height, span = place
        if reach - height > deepest and (height == 0.0 or _is_flat(simulation)):
            lowest = max(reach, _reach(spawned.robot, spawned.robot.links) or reach)
            least = math.ceil((lowest + _FREE) * 100.0) / 100.0
            yield finding(
                span,
                f"the wheels of {spawned.robot.name.value!r} start {reach - height:.3g} m in the "
                f"ground: write `{_OPTION} {least:g}`",
            )


def _height(node: Node) -> tuple[float, Span] | None:
    """Return the height at which a node puts a robot, and its place; None if it is not known."""
    words = [word.value for word in node.arguments]
    if _OPTION not in words:
        return None if node.parameters or node.unread else (0.0, node.span)
    at = words.index(_OPTION) + 1
    try:
        return float(words[at]), node.arguments[at].span
    except (IndexError, ValueError):
        return None


def _reach_of_wheels(robot: Robot) -> float | None:
    """Return how far wheels reach below the origin of a robot, metres; None if it is not known."""
    if WORLD in robot.tree.links or robot.is_static:
        return None
    return _reach(robot, robot.wheels)


def _reach(robot: Robot, links: Iterable[Link]) -> float | None:
    """Return how far the collisions of links reach below the origin of their robot, metres."""
    boxes = [robot.box_of(it, visuals_too=False) for it in links if it.collisions]
    known = [-box.low[2] for box in boxes if box is not None]
    return max(known) if known and len(known) == len(boxes) else None


def _is_flat(simulation: Simulation) -> bool:
    """Return whether the ground of the worlds is known to be at z = 0."""
    planes = [z for world in simulation.worlds for z in _planes(world)]
    level = all(abs(z) <= _LEVEL for z in planes)
    return level and bool(planes or any(server.own_world for server in simulation.servers))


def _planes(world: World) -> Iterator[float]:
    """Yield the heights of the planes of a world, metres."""
    for model in world.models:
        for link in model.links:
            for shape in link.collisions:
                pose = model.pose_of_part(link, shape.pose)
                if shape.geometry.shape == "plane" and pose is not None:
                    yield pose.translation[2]


def _is_hilly(world: World) -> bool:
    shapes = (shape for model in world.models for shape in model.shapes())
    return any(shape.geometry.shape == "heightmap" for shape in shapes)


_LAUNCH = """<launch>
  <include file="$(find-pkg-share ros_gz_sim)/launch/gz_sim.launch.py">
    <arg name="gz_args" value="-r empty.sdf"/>
  </include>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/rover.urdf')"/>
  </node>
  <node pkg="ros_gz_sim" exec="create" args="-topic robot_description -name rover{z}"/>{mark}
</launch>
"""
_WHEEL = """<link name="{0}_wheel">
  <collision><geometry><sphere radius="0.1"/></geometry></collision>
</link>
<joint name="{0}_axle" type="continuous">
  <parent link="base_link"/><child link="{0}_wheel"/>
  <origin xyz="0 {1} {2}"/><axis xyz="0 1 0"/>
</joint>
"""
_FIXED = """<link name="world"/>
<joint name="hold" type="fixed"><parent link="world"/><child link="base_link"/></joint>
"""


def _rover(z: str, mark: str = "", axle: float = 0.0, more: str = "") -> dict[str, object]:
    wheels = "".join(_WHEEL.format(side, y, axle) for side, y in (("left", 1), ("right", -1)))
    return {
        "@bridge": True,
        "launch/rover.launch.py": None,
        "launch/rover.launch.xml": _LAUNCH.format(z=z, mark=mark),
        "urdf/rover.urdf": f'<robot name="rover">{more}<link name="base_link"/>{wheels}</robot>',
    }


_MARK = "  <!-- ^ WIR031 -->"
GOOD = [
    _rover(" -z 0.11"),
    _rover(" -z 0.085"),
    _rover("", axle=0.1),
    _rover("", more=_FIXED),
    _rover(" -z $(var height)"),
]
BAD = [
    _rover("", _MARK),
    _rover(" -z 0.0", _MARK),
    _rover(" -z 0.05", _MARK),
    _rover(" -z 0.05", _MARK, axle=-0.05),
]
