"""A ROS topic whose name does not follow the SubT API.

Teams' programs find a robot's topics by their names: `cmd_vel`, `odom`, `imu/data`, `points`,
`front_scan`, `camera_front/image_raw`. Other names work only for their author. The rule judges
names by pattern, not by a list: the kind of data comes last, the place of the sensor (`front`,
`rear`, `left`, `right`, …) comes before it.

Fix: remap the bridge to the usual name.
Source: SubT API; review findings about names with `back` instead of `rear` and with the device
(`rs_`) in front; names in accepted packages.
"""

import re
from collections.abc import Iterator, Mapping

from checker.expand.launch.bridge import Bridge
from checker.expand.launch.graph import LaunchGraph
from checker.expand.spawner.reader import SAMPLE_NAME
from checker.model.robot import Robot
from checker.model.ros.topics import Channel, channels, comparable
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked

_NAMESPACE = f"/{SAMPLE_NAME}/"
_WORDS: Mapping[str, re.Pattern[str]] = {
    "contains 'back', expected 'rear'": re.compile(r"(?<![a-z])back(?![a-z])"),
    "starts with the device 'rs_', expected the place of the sensor": re.compile(r"(?:^|/)rs_"),
}
_LONGEST = 100
"""Characters of a name that are checked."""


@rule("ROS005", "unusual-ros-name", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, launch: LaunchGraph, context: Context) -> Findings:
    """Report names of bridged topics that do not follow the patterns."""
    for reason in dict.fromkeys((robot.missing_parts, robot.unread_plugins, *launch.unread)):
        if reason:
            yield unchecked(reason)
    known = {
        topic: channel for channel in channels(robot, context.release) for topic in channel.topics
    }
    for bridge in launch.bridges:
        # The args of a template say where a name starts, not how it goes on.
        if bridge.node.assumed_from or "$(" in bridge.ros_topic:
            continue
        channel = known.get(comparable(bridge.ign_topic))
        for fault in _faults(bridge, channel):
            yield finding(bridge, fault)


def _faults(bridge: Bridge, channel: Channel | None) -> Iterator[str]:
    name = bridge.ros_topic.removeprefix(_NAMESPACE)[:_LONGEST]
    of_gazebo = comparable(bridge.ros_topic) == comparable(bridge.ign_topic)
    if not of_gazebo:
        for fault, pattern in _WORDS.items():
            if pattern.search(name):
                yield f"ROS topic {name!r} {fault}"
    if channel is None or not channel.ros_name:
        return
    whose, example = f"{channel.what} of {channel.owner_name}", channel.ros_example
    if of_gazebo:
        yield f"{whose} has its Gazebo name in ROS, expected a name such as {example!r}"
    elif not bridge.ros_topic.startswith(_NAMESPACE):
        yield f"{whose} is {bridge.ros_topic!r} in ROS, outside the robot's namespace /<name>"
    elif not re.fullmatch(channel.ros_name, name):
        yield f"{whose} is {name!r} in ROS, expected a name such as {example!r}"


_TOPICS = "launch/vehicle_topics.launch"
_PREFIX = "/world/w/model/m/link/base_link/sensor/front"


def _robot(
    name: str, *, kind: str = "camera", topic: str = "image", namespace: str = "$(arg name)"
) -> dict[str, str]:
    mark = "  <!-- ^ ROS005 -->" if name.startswith("MARK ") else ""
    remap = f'<remap from="{_PREFIX}/{topic}" to="{name.removeprefix("MARK ")}"/>'
    return {
        "@fragment": f'<sensor name="front" type="{kind}"/>',
        _TOPICS: f"""<launch>
<arg name="name"/><arg name="world_name"/>
<group ns="{namespace}">
<node pkg="ros_ign_image" type="image_bridge" name="bridge"
  args="{_PREFIX}/{topic}">{mark}
  {remap}
</node>
</group>
</launch>
""",
    }


GOOD = [
    _robot("camera_front/image_raw"),
    _robot("front/left/image_raw"),
    _robot("background/image_raw"),
    _robot("rgbd_front/depth/image_raw", kind="rgbd_camera", topic="depth_image"),
    _robot("scan_front", kind="gpu_lidar", topic="scan"),
    _robot("gimbal/imu/data", kind="imu", topic="imu"),
]
BAD = [
    _robot("MARK camera_back/image_raw"),
    _robot("MARK rs_front/image_raw"),
    _robot("MARK front/picture"),
    _robot("MARK front/image_raw", namespace="/"),
    _robot("MARK inertia", kind="imu", topic="imu"),
    _robot("MARK front_laser", kind="gpu_lidar", topic="scan"),
    _robot(f"MARK {_PREFIX}/image"),
]
