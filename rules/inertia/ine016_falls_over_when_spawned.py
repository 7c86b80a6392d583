"""A robot that a launch file spawns into Gazebo, and that falls over at once.

An arm on a narrow base stands in the viewer, which does not simulate it. In Gazebo it needs a wide
base, or a fixed joint to the link `world`: else it falls as soon as its centre of mass is beside
the support.

It is reported for robots without a drive that stand on the base alone, in the pose where all joints
are at zero. Robots of ros2_control with `initial_value` start in another pose, and are not checked.

Fix: add `<link name="world"/>` and a joint of the type `fixed` from it to the base.
Source: statics: the centre of mass is outside the support; ros_gz_sim, `create`, and gazebo_ros,
`spawn_entity.py`: a spawned robot is free to move.
"""

import math

from checker.model.robot import Robot
from checker.physics.mass.mass_properties import MassProperties
from checker.ros.simulation import Simulations
from checker.rule import Concern, Findings, Severity, finding, rule

_STARTS = "initial_value"


@rule("INE016", "falls-over-when-spawned", Severity.WARNING, Concern.ROBOT)
def check(masses: MassProperties, simulations: Simulations) -> Findings:
    """Report a spawned robot that is not fixed to the world, with its centre of mass aside."""
    robot, angle, centre = masses.robot, masses.tip_angle, masses.centre
    if masses.unbalanced or angle is None or centre is None or angle >= 0.0:
        return
    tree = robot.tree
    stands = masses.standing and masses.standing <= tree.base
    if not stands or robot.is_static or robot.drives or robot.flies:
        return
    if any(_is_loose(each, robot) for each in _spawned(simulations)):
        base = tree.links[min(masses.standing)]
        at = ", ".join(f"{part:.3f}" for part in centre[:2])
        yield finding(
            base,
            f"the robot falls over in Gazebo: no joint fixes {base.name.value!r} to the world, and "
            f"the centre of mass is at x, y = {at} m, outside the support "
            f"(tip angle {math.degrees(angle):.0f}°)",
        )


def _spawned(simulations: Simulations) -> list[Robot]:
    launched = simulations.launched
    return [each.robot for it in launched for each in (*it.robots, *it.classic_robots)]


def _is_loose(spawned: Robot, robot: Robot) -> bool:
    """Return whether a spawned robot is the same, and nothing holds it or sets its joints."""
    source = spawned.document.source
    is_same = source.file == robot.document.source.file
    free = not spawned.tree.links_fixed_to_world and not spawned.is_static
    return is_same and free and _STARTS not in source.text


_URDF = """<robot name="rover">{world}
  <link name="base_link">{mark}
    <inertial>
      <mass value="4"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <collision><geometry><box size="0.4 0.4 0.4"/></geometry></collision>
  </link>
  <link name="arm">
    <inertial>
      <origin xyz="{reach} 0 0"/>
      <mass value="6"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <collision><origin xyz="{reach} 0 0"/><geometry><sphere radius="0.05"/></geometry></collision>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base_link"/><child link="arm"/><origin xyz="0 0 0.3"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="80" velocity="1"/>
  </joint>
</robot>
"""
_WORLD = """
  <link name="world"/>
  <joint name="base" type="fixed"><parent link="world"/><child link="base_link"/></joint>"""


def _example(reach: float, world: str = "", mark: str = "") -> dict[str, object]:
    urdf = _URDF.format(reach=reach, world=world, mark=mark)
    return {"@bridge": True, "urdf/rover.urdf": urdf}


GOOD = [_example(0.2), _example(0.6, world=_WORLD)]
BAD = [_example(0.6, mark="  <!-- ^ INE016 -->")]
