"""A robot_state_publisher that gets no robot.

It ends when it starts: "robot_description parameter must not be empty". Nothing publishes the robot
and its transforms, so RViz shows nothing, and what reads `robot_description` waits.

Of a node that does not start by default it is a warning. The description may be a parameter, a file
of parameters or an argument of the node; a node whose parameters are not all known is not reported.

Fix: give the node the parameter `robot_description`, usually the output of xacro; remove a second
node.
Source: robot_state_publisher, README: the parameter must be set when the node starts, or it fails
to start; `description_from_topic` (ros/robot_state_publisher#234).
"""

from checker.launch.ros2.graph import LaunchGraph, Node, Ros2Launch
from checker.ros.transforms import STATE_PUBLISHER
from checker.ros.wiring.frames import may_get_description
from checker.rule import Concern, Findings, Severity, finding, rule

_LINE = (
    "parameters=[{'robot_description': ParameterValue(Command(['xacro ', FILE]), value_type=str)}]"
)


@rule("WIR027", "state-publisher-without-description", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report nodes robot_state_publisher that nothing gives a description."""
    for graph in launch.entries:
        for node in graph.nodes:
            if node.package.value == STATE_PUBLISHER and not may_get_description(node):
                cure = "remove it" if _is_second(node, graph) else f"expected {_LINE}"
                yield finding(
                    node.executable,
                    "robot_state_publisher ends when it starts, since it gets no "
                    f"robot_description: {cure}",
                    severity=None if node.starts else Severity.WARNING,
                )


def _is_second(node: Node, graph: LaunchGraph) -> bool:
    """Return whether another node of the launch publishes the robot already."""
    return any(
        it.package.value == STATE_PUBLISHER and it.namespace == node.namespace
        for it in graph.nodes
        if it.starts and may_get_description(it)
    )


_XML = """<launch>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">@</node>
</launch>
"""
_FILE = "launch/view.launch.xml"


def _example(inside: str) -> dict[str, object]:
    return {"@ros2": True, _FILE: _XML.replace("@", inside)}


_PYTHON = """from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([
        Node(package="robot_state_publisher", executable="robot_state_publisher",%
             name="state"@),
    ])
"""


def _python(more: str, mark: str = "") -> dict[str, object]:
    text = _PYTHON.replace("@", more).replace("%", mark)
    return {"@ros2": True, "launch/view.launch.py": text}


GOOD = [
    _example('<param name="robot_description" value="&lt;robot name=\'rover\'/&gt;"/>'),
    _example('<param from="$(find-pkg-share rover)/config/state.yaml"/>'),
    _example('<param name="description_from_topic" value="true"/>'),
    _python(', arguments=["/tmp/rover.urdf"]'),
    _python(", parameters=[made_elsewhere()]"),
]
_SECOND = (
    '</node>\n  <node pkg="robot_state_publisher" exec="robot_state_publisher">\n'
    '    <param name="robot_description" value="&lt;robot name=\'rover\'/&gt;"/>'
)
BAD = [
    _example(f"  <!-- ^ WIR027 -->{_SECOND}"),
    _example("  <!-- ^ WIR027 -->"),
    _example('<param name="use_sim_time" value="true"/>  <!-- ^ WIR027 -->'),
    _python("", "  # ^ WIR027"),
    _python(', parameters=[{"use_sim_time": True}]', "  # ^ WIR027"),
]
