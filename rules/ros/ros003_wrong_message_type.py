"""A bridge has another message type or direction than its topic.

The bridge starts, finds no message that it can convert, and publishes nothing in ROS. A bridge for
`cmd_vel` from Gazebo to ROS never moves the robot. Even with matching types, a LaserScan contains
only one row of a lidar that has many, and no lidar of Gazebo publishes a Range.

Fix: write the types of the message, and `[` for Gazebo to ROS, `]` for ROS to Gazebo. Bridge
`scan/points` of a lidar with several rows as PointCloud2.
Source: message types of gz-sensors and Gazebo's systems, conversions of ros_ign_bridge; a review
asked the author to replace the LaserScan of a lidar with 16 rows.
"""

from collections import defaultdict
from collections.abc import Iterator, Sequence

from checker.finding import Fix, Safety
from checker.launch.ros1.bridge import MARKS, Bridge, Direction
from checker.launch.ros1.graph import LaunchGraph
from checker.model.components import Plugin, Sensor
from checker.model.robot import Robot
from checker.ros.added_bridges import bridging
from checker.ros.topics import Channel, by_topic, channels
from checker.rule import (
    Concern,
    Context,
    Findings,
    Severity,
    finding,
    replace_text,
    rule,
    unchecked,
)
from checker.source.text import Span

_WAYS = {Direction.TO_ROS: "Gazebo to ROS", Direction.TO_IGN: "ROS to Gazebo"}
_RANGE = "sensor_msgs/Range"
_VECTOR, _SINGLE = "ignition.msgs.Pose_V", "ignition.msgs.Pose"


@rule("ROS003", "wrong-message-type", Severity.ERROR, Concern.INTERFACE)
def check(robot: Robot, launch: LaunchGraph, context: Context) -> Findings:
    """Report bridges whose types or direction do not fit their topic."""
    for reason in dict.fromkeys((robot.missing_parts, robot.unread_plugins, *launch.unread)):
        if reason:
            yield unchecked(reason)
    ends = _ends(robot, context.release)
    bridged = by_topic(launch.bridges)
    for topic, bridges in bridged.items():
        here = ends.get(topic, ())
        for bridge in bridges:
            for fault in (*_faults(bridge, here), *_of_later_release(bridge, context.release)):
                fix = _retyped(bridge, here, context.release)
                yield finding(bridge, f"{_bridge_label(bridge)} {fault}", fix=fix)
        fault = _one_row_of_many(here)
        if fault and f"{topic}/points" not in bridged:
            yield finding(
                bridges[0],
                f"{_bridge_label(bridges[0])} {fault}",
                key="one row of many",
                fix=bridging(launch, ends.get(f"{topic}/points", ())),
            )


def _ends(robot: Robot, release: str) -> dict[str, list[Channel]]:
    """Return the robot's channels of each topic; several plugins may share one."""
    ends: dict[str, list[Channel]] = defaultdict(list)
    for channel in channels(robot, release):
        for topic in channel.topics:
            ends[topic].append(channel)
    return ends


def _bridge_label(bridge: Bridge) -> str:
    assumed = bridge.node.assumed_from
    return f"{assumed} (content assumed)" if assumed else f"bridge {bridge.node.name!r}"


def _faults(bridge: Bridge, ends: Sequence[Channel]) -> Iterator[str]:
    ros, ign = _ros(bridge.ros_type), _ign(bridge.ign_type)
    ros_types = list(dict.fromkeys(name for end in ends for name in end.ros_types))
    if not ros_types:
        if ros == _RANGE:
            yield f"has the type {_RANGE}, which no sensor of Gazebo publishes; expected LaserScan"
        return
    whose = f"{ends[0].what} of {ends[0].owner_name}"
    ign_types = list(dict.fromkeys(name for end in ends for name in _stated_types(end)))
    if ign not in ign_types:
        yield f"reads {whose} as {bridge.ign_type}, expected {' or '.join(ign_types)}"
    elif ros not in ros_types:
        yield f"publishes {whose} as {bridge.ros_type}, expected {ros_types[0]}"
    ways = {end.direction for end in ends}
    if bridge.direction not in (*ways, Direction.BOTH):
        stated, expected = _WAYS[bridge.direction], _WAYS[ends[0].direction]
        yield f"bridges {whose} from {stated}, expected {expected}"


def _retyped(bridge: Bridge, ends: Sequence[Channel], release: str) -> Fix | None:
    """Return the fix that writes the types and the direction of a topic that has one of each."""
    if bridge.node.assumed_from or len(ends) != 1 or len(ends[0].ign_types) != 1:
        return None
    (end,), (ign,) = ends, ends[0].ign_types
    ros = bridge.ros_type if _ros(bridge.ros_type) in end.ros_types else end.ros_types[0]
    if release != "dome" and _ign(bridge.ign_type) == ign:
        ign = bridge.ign_type
    way = Direction.BOTH if bridge.direction is Direction.BOTH else end.direction
    stated = f"@{bridge.ros_type}{MARKS[bridge.direction]}{bridge.ign_type}"
    span = Span(bridge.span.source, bridge.span.end, bridge.span.end + len(stated))
    right = f"@{ros}{MARKS[way]}{ign}"
    return replace_text(span, right, Safety.UNSAFE) if span.text == stated else None


def _of_later_release(bridge: Bridge, release: str) -> Iterator[str]:
    """Yield what is wrong with a message that ros_ign_bridge of ROS 1 does not know."""
    later = bridge.ign_type.startswith("gz.") and "/msg/" not in bridge.ros_type
    if later and release == "dome" and bridge.node.package == "ros_ign_bridge":
        yield f"names {bridge.ign_type}, which Dome calls {_ign(bridge.ign_type)}"


def _stated_types(channel: Channel) -> tuple[str, ...]:
    """Return Gazebo's types of a channel; PosePublisher states which of two types it publishes."""
    plugin = channel.owner
    if not isinstance(plugin, Plugin) or _VECTOR not in channel.ign_types:
        return channel.ign_types
    stated = next((text.value.lower() for text in plugin.at("use_pose_vector_msg")), "false")
    return (_VECTOR,) if stated in ("1", "true") else (_SINGLE,)


def _one_row_of_many(ends: Sequence[Channel]) -> str:
    sensor = ends[0].owner if ends and ends[0].what == "scan" else None
    if not isinstance(sensor, Sensor) or sensor.lidar is None:
        return ""
    rows = sensor.lidar.rows
    if rows <= 1:
        return ""
    return (
        f"bridges the LaserScan of {ends[0].owner_name}, which has only one of its {rows:g} "
        "rows; expected its scan/points as PointCloud2"
    )


def _ros(message: str) -> str:
    """Return a message type as ROS 1 spells it."""
    return message.replace("/msg/", "/")


def _ign(message: str) -> str:
    """Return a message type as Gazebo Dome spells it."""
    return "ignition." + message.removeprefix("gz.") if message.startswith("gz.") else message


_TOPICS = "launch/vehicle_topics.launch"
_LIDAR = """<sensor name="lidar" type="gpu_lidar"><lidar><scan>
  <horizontal><samples>440</samples></horizontal><vertical><samples>{}</samples></vertical>
</scan></lidar></sensor>"""
_HERE = "/world/w/model/m/link/base_link/sensor/lidar/scan"
_SCAN = f"{_HERE}@sensor_msgs/LaserScan[ignition.msgs.LaserScan"
_POINTS = f"{_HERE}/points@sensor_msgs/PointCloud2[ignition.msgs.PointCloudPacked"
_POINTS_OF_GZ = f"{_HERE}/points@sensor_msgs/msg/PointCloud2[gz.msgs.PointCloudPacked"
_CAMERA = '<sensor name="lidar" type="camera"/>'
_INFO = "/world/w/model/m/link/base_link/sensor/lidar/camera_info"


def _plugin(name: str, content: str = "") -> str:
    return f'<plugin filename="p.so" name="ignition::gazebo::systems::{name}">{content}</plugin>'


def _robot(fragment: str, *bridges: str, program: str = "parameter_bridge") -> dict[str, str]:
    nodes = (
        f'<node pkg="ros_ign_bridge" type="{program}" name="b{number}"\n args="{args}"/>'
        for number, args in enumerate(bridges)
    )
    lines = "\n".join(("<launch>", *nodes, "</launch>"))
    marked = lines.replace('MARK"/>', '"/>  <!-- ^ ROS003 -->')
    return {"@fragment": fragment, _TOPICS: marked}


_MARK = "MARK"
_TWIST = "/model/m/cmd_vel@geometry_msgs/Twist{}ignition.msgs.Twist"
_POSE = "/model/m/pose@{}[{}"
_POSES = "<use_pose_vector_msg>true</use_pose_vector_msg>"

GOOD = [
    _robot(_LIDAR.format(1), _SCAN),
    _robot(_LIDAR.format(16), _POINTS),
    _robot(_LIDAR.format(16), _SCAN, _POINTS),
    _robot(_LIDAR.format(16), _POINTS_OF_GZ),
    _robot(_plugin("DiffDrive"), _TWIST.format("]")),
    _robot(_plugin("DiffDrive"), _TWIST.format("@")),
    _robot(_plugin("PosePublisher", _POSES), _POSE.format("tf2_msgs/TFMessage", _VECTOR)),
    _robot(_plugin("PosePublisher"), _POSE.format("geometry_msgs/TransformStamped", _SINGLE)),
]
BAD = [
    _robot(_LIDAR.format(16), _SCAN + _MARK),
    _robot(_LIDAR.format(1), f"{_HERE}@sensor_msgs/Range[ignition.msgs.LaserScan{_MARK}"),
    _robot(_LIDAR.format(1), f"/range@sensor_msgs/Range[ignition.msgs.LaserScan{_MARK}"),
    _robot(_plugin("DiffDrive"), _TWIST.format("[") + _MARK),
    _robot(_CAMERA, _INFO + _MARK, program="image_bridge"),
    _robot(
        _plugin("PosePublisher", _POSES),
        _POSE.format("geometry_msgs/TransformStamped", _SINGLE) + _MARK,
    ),
    _robot(_LIDAR.format(1), f"{_HERE}@sensor_msgs/LaserScan[gz.msgs.LaserScan{_MARK}"),
]
