"""Gazebo gets a robot with wheels or joints that nothing moves.

A rover stands in the world, reads no velocity, and publishes no odometry: navigation and mapping
that are started beside it wait for it. The joints of an arm swing freely, so it collapses, and no
command reaches them. The description was written for RViz, or for the real robot.

It is reported where the description that a launch file spawns has no plugin outside of its sensors
and no `<ros2_control>`. A macro that is not available may control the joints of an arm: that is not
checked.

Fix: add what the message names, with `<ros2_control>` the plugin that reads it; and the sensors
that are needed. Wheels on parallel axes need a diff drive, wheels on crossing axes a planar drive,
and an arm `<ros2_control>`.
Source: gazebo_plugins; gz-sim, systems/diff_drive and velocity_control; gz_ros2_control.
"""

from collections.abc import Sequence

from checker.base.words import and_list
from checker.model.components import Joint
from checker.model.geometry.transform import dot
from checker.model.robot import Robot
from checker.ros.spawned import CLASSIC_SPAWNS, SpawnedRobot
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_FEWEST = 2
"""Wheels on joints that turn without end, or joints of an arm."""
_OF_ARMS = ("revolute", "prismatic")
_PARALLEL = 0.99
"""Cosine of the angle between two axes of wheels, at least."""
_CONTROL = "<ros2_control> with a command interface for each joint"


@rule("WIR020", "spawned-without-drive", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report spawned robots that move, and have neither a plugin nor ros2_control."""
    for spawned in wiring.spawned:
        robot = spawned.robot
        if not spawned.node.starts or _is_moved(spawned):
            continue
        wheels = {link.scoped_name for link in robot.wheels}
        ties = [it for it in robot.tree.ties if it.joint.type.value == "continuous"]
        rolling = [it for it in ties if it.child in wheels]
        joints = [it.name.value for it in robot.joints if it.type.value in _OF_ARMS]
        if len(rolling) >= _FEWEST:
            names = and_list([repr(it.child) for it in rolling])
            lacks = f"a drive: no plugin and no ros2_control turns {names}"
            advice = _drive(robot, [it.joint for it in rolling], spawned.node.program)
        elif len(joints) >= _FEWEST and robot.missing_parts:
            yield unchecked(robot.missing_parts)
            continue
        elif len(joints) >= _FEWEST:
            some = f"{joints[0]!r} to {joints[-1]!r}"
            lacks = f"control: no plugin and no ros2_control holds its {len(joints)} joints, {some}"
            advice = _CONTROL
        else:
            continue
        yield finding(
            spawned.node.span,
            f"Gazebo gets robot {robot.name.value!r} without {lacks}; add {advice}",
            related=[(robot.name.span, "the robot")],
        )


def _drive(robot: Robot, wheels: Sequence[Joint], program: tuple[str, str]) -> str:
    """Return the plugin that drives wheels on such axes, in the simulator that a node spawns to."""
    in_classic = program in CLASSIC_SPAWNS
    if _cross(robot, wheels):
        plugin = "libgazebo_ros_planar_move.so" if in_classic else "gz-sim-velocity-control-system"
        return f"{plugin}, as the axes of the wheels cross, or {_CONTROL}"
    return "libgazebo_ros_diff_drive.so" if in_classic else "gz-sim-diff-drive-system"


def _cross(robot: Robot, wheels: Sequence[Joint]) -> bool:
    """Return whether two wheels turn on axes that are not parallel, as of an omni-wheel base."""
    found = (robot.axis_in_model(joint, axis) for joint in wheels for axis in joint.axes)
    axes = [axis for axis in found if axis is not None]
    return any(abs(dot(axes[0], other)) < _PARALLEL for other in axes[1:])


def _is_moved(spawned: SpawnedRobot) -> bool:
    """Return whether anything may move the robot, or nothing has to."""
    robot = spawned.robot
    has_control = spawned.control is not None or robot.element.child("ros2_control") is not None
    return bool(robot.plugins) or has_control or robot.is_static


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
_ARM = """<link name="{0}"/><joint name="{0}_joint" type="revolute">
  <parent link="{1}"/><child link="{0}"/><axis xyz="0 1 0"/>
  <limit lower="-1" upper="1" effort="9" velocity="1"/>
</joint>
"""
_UPPER, _FOREARM = _ARM.format("upper", "base_link"), _ARM.format("forearm", "upper")
_MARK = "  <!-- ^ WIR020 -->"
GOOD = [
    _rover(_DRIVE),
    _rover("", "", "caster"),
    _rover(_UPPER, "", "caster"),
    _rover('<ros2_control name="c" type="system"/>'),
]
BAD = [
    _rover("", _MARK),
    _rover(_LIDAR, _MARK),
    _rover(_UPPER + _FOREARM, _MARK, "caster"),
]
