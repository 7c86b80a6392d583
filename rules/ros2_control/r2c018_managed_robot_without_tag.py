"""A controller manager whose robot has no ros2_control tag.

`ros2_control_node` loads the hardware that the `<ros2_control>` tags of its description name.
Without a tag, reading the description fails with "no ros2_control tag". Where the description is
the parameter `robot_description`, as in Humble, the node ends; where it comes from a topic, the
node may stay without hardware. In both cases no controller starts, and spawners wait forever.

It is reported where the description was read completely, and each description that the node may get
from the launch file lacks the tag: its parameter (not since Jazzy, which takes the topic alone),
and those of robot_state_publisher. Tags count directly below `<robot>`.

Fix: write `<ros2_control>` with the hardware and its joints into the description, or load the
description that has it.
Source: hardware_interface, `parse_control_resources_from_urdf`, which throws if a tag is not found;
gazebo_ros2_control, issue 116 (the text); franka_ros2, issue 139 (the node of Humble ends with what
this function throws).
"""

from checker.launch.ros2.graph import Node
from checker.model.robot import Robot
from checker.package.package import Package
from checker.ros.robot_description import NAME
from checker.ros.ros2_control.distributions import ORDER, is_from, named_distribution
from checker.ros.ros2_control.launched import LaunchedControl
from checker.ros.transforms import STATE_PUBLISHER
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.rulebook.example_parts import ros2_control


@rule("R2C018", "managed-robot-without-tag", Severity.ERROR, Concern.INTERFACE)
def check(launched: LaunchedControl, package: Package, context: Context) -> Findings:
    """Report each ros2_control_node that certainly gets a robot without a <ros2_control> tag."""
    distribution = named_distribution(package, context)
    by_topic = distribution in ORDER and is_from(distribution, "jazzy")
    for node in launched.managers:
        robots = _robots(launched, node, by_topic=by_topic)
        if robots and not any(map(_may_have_tag, robots)):
            robot = robots[0]
            yield finding(
                node.executable,
                f"robot {robot.name.value!r} of {robot.document.source.file} has no "
                "<ros2_control> tag: the ros2_control_node that gets it loads no hardware, and no "
                "controller starts; write the tag with the hardware and its joints",
                key=robot.document.source.file,
                related=[(robot.element, "the robot without the tag")],
            )


def _robots(launched: LaunchedControl, node: Node, *, by_topic: bool) -> list[Robot]:
    """Return the robots that a controller manager may get; none if one is not known."""
    nodes = launched.graph.nodes_and_spawns
    publishers = [
        it for it in nodes if it.package.value == STATE_PUBLISHER and it.starts is not False
    ]
    given = publishers
    if not by_topic and node.parameter(NAME) is not None:
        given = [node, *publishers]
    elif not launched.is_complete or {it.namespace for it in publishers} != {node.namespace}:
        return []
    found = [launched.spawned.given_robots(launched.graph, it) for it in given]
    robots = [robot for each in found for robot in each if isinstance(robot, Robot)]
    return robots if len(robots) == len(given) and all(len(it) == 1 for it in found) else []


def _may_have_tag(robot: Robot) -> bool:
    """Return whether a robot has the tag, or gets it from a macro that is not available."""
    is_urdf = robot.document.root.tag == "robot"
    has_tag = robot.document.root.child("ros2_control") is not None
    return has_tag or not is_urdf or bool(robot.unresolved_includes)


_LAUNCH = """<launch>
  <arg name="real" default="true"/>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/arm.urdf
        real:=@')"/>
  </node>
  <node pkg="controller_manager" exec="ros2_control_node">%
  </node>
</launch>
"""
_OWN = """
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/arm.urdf real:=false')"/>"""


def _arm(inside: str = "", real: str = "false", distribution: str = "Humble") -> dict[str, object]:
    return {
        "@bridge": True,
        "README.md": f"An arm for ROS 2 {distribution}.\n",
        "launch/rover.launch.py": None,
        "launch/arm.launch.xml": _LAUNCH.replace("@", real).replace("%", inside),
        "urdf/arm.urdf": f"""<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
<xacro:arg name="real" default="false"/>
<link name="base_link"/>
<xacro:if value="$(arg real)">{ros2_control()}</xacro:if>
</robot>
""",
    }


_MARK = "  <!-- ^ R2C018 -->"
GOOD = [
    _arm(real="true"),
    _arm(real="$(var real)"),
    _arm(_OWN, real="true"),
]
BAD = [
    _arm(_MARK),
    _arm(_MARK + _OWN),
    _arm(_MARK, distribution="Jazzy"),
]
