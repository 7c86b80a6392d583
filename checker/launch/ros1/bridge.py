"""Bridges between Gazebo and ROS: the command lines of the bridge programs.

`parameter_bridge` takes `topic@ros_type[ign_type` (Gazebo to ROS), `]` (ROS to Gazebo) or a second
`@` (both ways); `image_bridge` takes plain topics. The programs kept this language while their
packages were renamed: ros1_ign_bridge, ros_ign_bridge, ros_gz_bridge.
"""

from __future__ import annotations

import enum
import re
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.source.text import Located, Span

if TYPE_CHECKING:
    from checker.launch.ros1.graph import Node


class Direction(enum.StrEnum):
    """Direction of a bridge."""

    TO_ROS = "to_ros"
    TO_IGN = "to_ign"
    BOTH = "both"


class BridgeKind(enum.StrEnum):
    """Program of a bridge."""

    PARAMETER = "parameter"
    IMAGE = "image"


PROGRAMS = {"parameter_bridge": BridgeKind.PARAMETER, "image_bridge": BridgeKind.IMAGE}
PASSES_NOTHING = frozenset(
    {
        *("ros_ign_bridge", "ros_ign_image", "ros_ign_point_cloud", "ros1_ign_bridge"),
        *("ros1_ign_image", "ros_gz_bridge", "ros_gz_image", "ros_gz_point_cloud", "subt_ros"),
        *("controller_manager", "gazebo_ros", "joint_state_publisher", "joy", "ps3joy"),
        *("robot_state_publisher", "rviz"),
        *("static_transform_publisher", "teleop_twist_joy", "teleop_twist_keyboard", "tf"),
        *("tf2_ros", "topic_tools", "twist_mux", "xacro"),
    }
)
"""Packages whose nodes pass no topic of Gazebo but those that their command lines name."""
_DIRECTIONS = {"[": Direction.TO_ROS, "]": Direction.TO_IGN, "@": Direction.BOTH}
MARKS = {direction: mark for mark, direction in _DIRECTIONS.items()}
_PARAMETER = re.compile(r"([^@\[\]]+)@([^@\[\]]+)([@\[\]])([^@\[\]]+)\Z")


class Bridge(Record, eq=False):
    """One topic that a node passes between Gazebo and ROS.

    Attributes:
        ign_topic: Topic on Gazebo's side.
        ros_topic: Absolute topic on ROS's side, after remaps and namespace.
        ros_type: Message type, such as `sensor_msgs/Imu`.
        ign_type: Message type, such as `ignition.msgs.IMU`.
        direction: The direction of messages.
        kind: The program that bridges.
        node: The node that does it.
        span: The topic within the node's `args`.
    """

    ign_topic: str
    ros_topic: str
    ros_type: str
    ign_type: str
    direction: Direction
    kind: BridgeKind
    node: Node
    span: Span

    @property
    def sensor(self) -> SensorTopic | None:
        """The sensor whose default topic is bridged, if it is one."""
        return SensorTopic.parse(self.ign_topic)


class SensorTopic(Record):
    """Parts of a sensor's default topic in Gazebo.

    `suffix` is what is behind the sensor's name: `scan/points`, or empty.
    """

    world: str
    model: str
    link: str
    sensor: str
    suffix: str

    @classmethod
    def parse(cls, topic: str) -> SensorTopic | None:
        """Read `/world/W/model/M/link/L/sensor/S/…`; None for any other topic."""
        parts = topic.split("/", 9)
        if len(parts) < 9 or parts[0] or parts[1:9:2] != ["world", "model", "link", "sensor"]:
            return None
        if not all(parts[2:9:2]):
            return None
        suffix = parts[9] if len(parts) > 9 else ""
        return cls(parts[2], parts[4], parts[6], parts[8], suffix)


def read_bridges(node: Node, words: Iterable[Located[str]]) -> Iterator[Bridge | Located[str]]:
    """Yield the bridges of a node's command line, and the words that cannot be read."""
    kind = PROGRAMS.get(node.type)
    if kind is None:
        return
    for word in words:
        # `a:=b` is for ROS itself and `-x` an option: neither names a topic.
        if ":=" in word.value or word.value.startswith("-"):
            continue
        if kind is BridgeKind.IMAGE:
            yield _image_bridge(node, word)
        else:
            yield _parameter_bridge(node, word) or word


def _image_bridge(node: Node, word: Located[str]) -> Bridge:
    topic = word.value
    return Bridge(
        topic,
        node.resolve(topic),
        "sensor_msgs/Image",
        "ignition.msgs.Image",
        Direction.TO_ROS,
        BridgeKind.IMAGE,
        node,
        word.span,
    )


def _parameter_bridge(node: Node, word: Located[str]) -> Bridge | None:
    match = _PARAMETER.match(word.value)
    if match is None:
        return None
    topic, ros_type, mark, ign_type = match.groups()
    written = word.span.text.find("@")
    span = word.span
    if written > 0:
        span = Span(span.source, span.start, span.start + written, span.holder)
    return Bridge(
        topic,
        node.resolve(topic),
        ros_type,
        ign_type,
        _DIRECTIONS[mark],
        BridgeKind.PARAMETER,
        node,
        span,
    )
