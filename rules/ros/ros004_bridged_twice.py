"""One topic is bridged twice, or two topics share a name in ROS.

Two topics with the same name are mixed: a subscriber receives the messages of both sensors in turn.
Two bridges of one topic convert every message twice, and with the same name each message arrives
twice. The camera_info of an rgbd camera may be bridged once for its colour and once for its depth
image.

Fix: remove one of the two bridges, or give each topic its own name.
Source: SubT reviews of launch files copied from other robots.
"""

from collections import defaultdict
from collections.abc import Iterable

from checker.launch.ros1.bridge import Bridge, Direction
from checker.launch.ros1.graph import LaunchGraph
from checker.ros.topics import comparable
from checker.rule import Concern, Findings, Severity, finding, rule

_SHARED = "camera_info"


@rule("ROS004", "bridged-twice", Severity.WARNING, Concern.INTERFACE)
def check(launch: LaunchGraph) -> Findings:
    """Report second bridges of one topic, and second topics with the same name."""
    known = [
        bridge
        for bridge in launch.bridges
        if "$(" not in bridge.ign_topic and not bridge.node.usual
    ]
    for again, first in _pairs(known, ros=False):
        shared = again.ign_topic.endswith(f"/{_SHARED}") and again.ros_topic != first.ros_topic
        name = again.ign_topic.rsplit("/", 1)[-1]
        whose = f" of sensor {again.sensor.sensor!r}" if again.sensor else ""
        yield finding(
            again,
            f"{name}{whose} is bridged twice: by {again.node.name!r} to {_label(again)}, and by "
            f"{first.node.name!r} to {_label(first)}",
            severity=Severity.INFO if shared else None,
            key=_SHARED if shared else "",
            related=[(first, "the first bridge")],
        )
    to_ros = [bridge for bridge in known if bridge.direction is Direction.TO_ROS]
    for again, first in _pairs(to_ros, ros=True):
        if comparable(again.ign_topic) != comparable(first.ign_topic):
            yield finding(
                again,
                f"{_label(again)} gets messages from {again.node.name!r} and from "
                f"{first.node.name!r}, expected one Gazebo topic for each name",
                related=[(first, "the other bridge")],
            )


def _pairs(bridges: Iterable[Bridge], *, ros: bool) -> list[tuple[Bridge, Bridge]]:
    """Return bridges whose topic an earlier one already has, each with the first of them."""
    by_name: dict[tuple[str, Direction], list[Bridge]] = defaultdict(list)
    for bridge in bridges:
        topic = bridge.ros_topic if ros else comparable(bridge.ign_topic)
        by_name[topic, bridge.direction].append(bridge)
    return [(again, first) for first, *others in by_name.values() for again in others]


def _label(bridge: Bridge) -> str:
    """Return the ROS topic as the launch file names it, without the robot's namespace."""
    namespace = bridge.node.namespace.rstrip("/")
    return bridge.ros_topic.removeprefix(f"{namespace}/")


_TOPICS = "launch/vehicle_topics.launch"
_ARGS = "/world/w/model/m/link/l/sensor/{0}@sensor_msgs/{1}[ignition.msgs.{1}"


def _launch(*bridges: tuple[str, str, str]) -> dict[str, str]:
    """Make a launch file of bridges: topic, type, name in ROS."""
    nodes = []
    for number, (topic, message, name) in enumerate(bridges):
        mark = "  <!-- ^ ROS004 -->" if name.startswith("MARK ") else ""
        nodes.append(
            f'<node pkg="ros_ign_bridge" type="parameter_bridge" name="b{number}"\n'
            f'  args="{_ARGS.format(topic, message)}">{mark}\n'
            f'  <remap from="/world/w/model/m/link/l/sensor/{topic}" '
            f'to="{name.removeprefix("MARK ")}"/></node>'
        )
    return {_TOPICS: "\n".join(("<launch>", *nodes, "</launch>"))}


GOOD = [
    _launch(("a/image", "Image", "front/image_raw"), ("b/image", "Image", "rear/image_raw")),
    _launch(("a/scan", "LaserScan", "scan"), ("a/scan/points", "PointCloud2", "points")),
]
BAD = [
    _launch(("a/imu", "Imu", "imu/data"), ("a/imu", "Imu", "MARK imu/data")),
    _launch(("a/imu", "Imu", "imu/data"), ("a/imu", "Imu", "MARK imu/other")),
    _launch(("a/imu", "Imu", "imu/data"), ("b/imu", "Imu", "MARK imu/data")),
    _launch(
        ("a/camera_info", "CameraInfo", "camera_info"),
        ("a/camera_info", "CameraInfo", "MARK depth/camera_info"),
    ),
]
