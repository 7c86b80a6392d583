"""A spawner waits for a robot on a topic that nothing publishes.

The robot never appears: `create -topic X` and `spawn_entity.py -topic X` wait until a description
is published on that topic. robot_state_publisher publishes it on `robot_description`, in the
namespace of its node: a namespace on only one of the two nodes, or a remap, makes the topics differ
as well.

It is reported where the launch file starts robot_state_publisher, and all other nodes that it
starts are known. A spawner in a separate launch file may belong to the robot_state_publisher of
another file.

Fix: give the spawner the topic of robot_state_publisher, and both the same namespace.
Source: ros_gz_sim, create.cpp; gazebo_ros, spawn_entity.py; robot_state_publisher.
"""

from collections.abc import Iterator
from itertools import pairwise

from checker.launch.ros2.graph import is_known
from checker.ros.spawned import CLASSIC_SPAWNS, SPAWNS
from checker.ros.transforms import STATE_PUBLISHER
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.text import Located

_OPTIONS = ("-topic", "--topic")
_DESCRIPTION = "std_msgs/msg/String"


@rule("WIR002", "spawner-without-description", Severity.ERROR, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report spawners whose topic no node of their launch file publishes."""
    published = wiring.publishers(_DESCRIPTION)
    descriptions = [topic for node in wiring.nodes for topic in _descriptions(node)]
    for node in wiring.nodes if descriptions else ():
        for word in _topics(node):
            topic = node.resolve(word.value)
            if not topic or topic in published:
                continue
            if unknown := wiring.more_publishers(_DESCRIPTION):
                yield unchecked(f"the publishers of {topic} are not all known: {unknown}")
                continue
            yield finding(
                word,
                f"{node.node.executable.value} waits for a robot on {topic}, which nothing in this "
                f"launch publishes: robot_state_publisher publishes {', '.join(descriptions)}",
            )


def _descriptions(node: WiredNode) -> Iterator[str]:
    """Yield the topic on which a robot_state_publisher publishes its robot."""
    if node.node.package.value == STATE_PUBLISHER:
        yield from (topic for topic, types in node.published_topics if _DESCRIPTION in types)


def _topics(node: WiredNode) -> Iterator[Located[str]]:
    if (node.node.package.value, node.node.executable.value) in (*SPAWNS, *CLASSIC_SPAWNS):
        for option, word in pairwise(node.node.arguments):
            if option.value in _OPTIONS and is_known(word.value):
                yield word


def _rover(topic: str, mark: str = "", state: str = "") -> dict[str, object]:
    return {
        "@bridge": True,
        "@launch": {
            '"-file", URDF]),': f'"-topic", "{topic}"]),{mark}',
            'executable="robot_state_publisher",': f'executable="robot_state_publisher",{state}',
        },
    }


_MARK = "  # ^ WIR002"
_CLASSIC = """<launch>
  <include file="$(find-pkg-share gazebo_ros)/launch/gazebo.launch.py"/>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" value="$(command 'cat rover.urdf')" type="str"/>
  </node>
  <node pkg="gazebo_ros" exec="spawn_entity.py" args="-topic @ -entity rover"/>%
</launch>
"""
_COMPONENT = """<launch>
  <node_container pkg="rclcpp_components" exec="component_container" name="state" namespace="">
    <composable_node pkg="robot_state_publisher" plugin="robot_state_publisher::RobotStatePublisher"
        namespace="r1"/>
  </node_container>
  <node pkg="ros_gz_sim" exec="create" args="-topic @"/>%
</launch>
"""


def _component(topic: str, mark: str = "") -> dict[str, object]:
    launch = _COMPONENT.replace("@", topic).replace("%", mark)
    return {"@bridge": True, "launch/state.launch.xml": launch}


_CLASSIC_FILE = "launch/classic.launch.xml"


def _classic(topic: str, mark: str = "") -> dict[str, object]:
    return {"@bridge": True, _CLASSIC_FILE: _CLASSIC.replace("@", topic).replace("%", mark)}


GOOD = [
    _rover("robot_description"),
    _rover("/robot_description"),
    _rover("/rover/robot_description", state=' namespace="rover",'),
    _rover("rover_description", state=' remappings=[("robot_description", "rover_description")],'),
    {**_rover("rover_description"), "@launch": {'"-file", URDF': '"-topic", topic()'}},
    _classic("robot_description"),
    _component("/r1/robot_description"),
]
BAD = [
    _rover("rover_description", _MARK),
    _rover("robot_description", _MARK, state=' namespace="rover",'),
    _rover("robot_description", _MARK, state=' remappings=[("robot_description", "model")],'),
    _classic("rover_description", "  <!-- ^ WIR002 -->"),
    _component("robot_description", "  <!-- ^ WIR002 -->"),
]
