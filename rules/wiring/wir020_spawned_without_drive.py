"""Gazebo gets a robot with wheels that nothing turns.

The robot stands in the world, reads no velocity, and publishes no odometry: navigation and mapping
that are started beside it wait for it. The description was written for RViz, or for the real robot.

It is reported where the description that a launch file spawns has no plugin outside of its sensors
and no `<ros2_control>`.

Fix: add a drive: `libgazebo_ros_diff_drive.so` in Gazebo Classic, `gz-sim-diff-drive-system` in
Gazebo Sim, or `<ros2_control>` with the plugin that reads it; and the sensors that are needed.
Source: gazebo_plugins; gz-sim, systems/diff_drive; gz_ros2_control.
"""

from checker.base.words import and_list
from checker.ros.spawned import SpawnedRobot
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule

_FEWEST = 2
"""Wheels on joints that turn without end."""


@rule("WIR020", "spawned-without-drive", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report spawned robots that have wheels, and neither a plugin nor ros2_control."""
    for spawned in wiring.spawned:
        wheels = _idle_wheels(spawned) if spawned.node.starts else []
        if len(wheels) >= _FEWEST:
            robot = spawned.robot
            yield finding(
                spawned.node.span,
                f"Gazebo gets robot {robot.name.value!r} without a drive: no plugin and no "
                f"ros2_control turns {and_list(wheels)}",
                related=[(robot.name.span, "the robot")],
            )


def _idle_wheels(spawned: SpawnedRobot) -> list[str]:
    """Return the quoted names of wheels of a robot without anything that could turn them."""
    robot = spawned.robot
    if robot.plugins or spawned.control is not None or robot.element.child("ros2_control"):
        return []
    wheels = {link.scoped_name for link in robot.wheels}
    turning = (tie for tie in robot.tree.ties if tie.joint.type.value == "continuous")
    return [repr(tie.child) for tie in turning if tie.child in wheels]


_LAUNCH = """<launch>
  <include file="$(find-pkg-share gazebo_ros)/launch/gazebo.launch.py"/>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/rover.urdf')"/>
  </node>
  <node pkg="gazebo_ros" exec="spawn_entity.py" args="-topic robot_description -entity rover"/>@
</launch>
"""
_WHEEL = """  <link name="{0}_wheel"/>
  <joint name="{0}_axle" type="continuous">
    <parent link="base_link"/><child link="{0}_wheel"/><axis xyz="0 1 0"/>
  </joint>
"""


def _rover(more: str, mark: str = "", *sides: str) -> dict[str, object]:
    wheels = "".join(map(_WHEEL.format, sides or ("left", "right")))
    return {
        "@bridge": True,
        "launch/rover.launch.py": None,
        "launch/rover.launch.xml": _LAUNCH.replace("@", mark),
        "urdf/rover.urdf": f'<robot name="rover">\n<link name="base_link"/>{wheels}{more}</robot>',
    }


_DRIVE = '<gazebo><plugin name="d" filename="libgazebo_ros_diff_drive.so"/></gazebo>'
_LIDAR = """<gazebo reference="base_link"><sensor name="lidar" type="ray">
  <plugin name="lidar" filename="libgazebo_ros_ray_sensor.so"/>
</sensor></gazebo>
"""
_MARK = "  <!-- ^ WIR020 -->"
GOOD = [_rover(_DRIVE), _rover("", "", "caster"), _rover('<ros2_control name="c" type="system"/>')]
BAD = [_rover("", _MARK), _rover(_LIDAR, _MARK)]
