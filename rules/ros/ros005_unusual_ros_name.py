"""A ROS topic whose name does not follow the SubT API.

Teams' programs find a robot's topics by their names: `cmd_vel`, `odom`, `imu/data`, `points`,
`front_scan`, `camera_front/image_raw`. Other names work only for their author. The rule judges
names by pattern, not by a list: the kind of data comes last, the place of the sensor (`front`,
`rear`, `left`, `right`, …) comes before it. The device (`d435/image_raw`, `velodyne/points`) does
not give the place; both together (`front_d435/image_raw`) are fine. All topics of a depth camera
have the same prefix, so that its points are found with its image.

The points of the robot's only 3D lidar are `points` on most robots. A prefix (`front_laser/points`)
is an info.

Fix: remap the bridge to the usual name.
Source: SubT API; review findings about names with `back` instead of `rear`, with the device
(`rs_`) in front, and about a depth image in `top/depth` with its points in `tof_top/depth/points`;
names in accepted packages, where images and points of RGBD cameras differ.
"""

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from checker.launch.ros1.bridge import Bridge
from checker.launch.ros1.graph import LaunchGraph
from checker.launch.spawner.reader import SAMPLE_NAME
from checker.model.components import Sensor
from checker.model.devices.known import KnownDevices, spaced
from checker.model.devices.lidar_class import LidarClass, class_of_sensor
from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType
from checker.ros.topics import Channel, channels, comparable
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked

_NAMESPACE = f"/{SAMPLE_NAME}/"
_WORDS: Mapping[str, re.Pattern[str]] = {
    "contains 'back', expected 'rear'": re.compile(r"(?<![a-z])back(?![a-z])"),
    "starts with the device 'rs_', expected the place of the sensor": re.compile(r"(?:^|/)rs_"),
}
_DEVICE = re.compile(
    r"\b(?:realsense|velodyne|ouster|hokuyo|rplidar|robosense|livox|kinect|xtion|orbbec|zed|flir"
    r"|blackfly|basler|arducam|ladybug|ueye|ximea|sick|gopro"
    r"|(?!cam|rgb|fov)[a-z]{1,3}\d{3,4}[a-z]{0,2})\b"
)
"""Makers and families of cameras and lidars, and type codes such as `d435i`."""
_PLACE = re.compile(
    r"\b(?:front|forwards?|rear|back|left|right|sides?|top|up|upper|upwards?|bottom|down|downwards?"
    r"|lower|cent(?:er|re)|middle|head|arm|gripper|mast|gimbal|pan|tilt|belly|roof|nose|tail|base"
    r"|body|chin|neck|tower|f[lr]|r[lr])\b"
)
_DATA = re.compile(r"(?:^|/)(?:depth|color|points|camera_info|image)(?![a-z])")
"""Start of the kind of data in a camera's topic."""
_LONGEST = 100
"""Characters of a name that are checked."""


@rule("ROS005", "unusual-ros-name", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, launch: LaunchGraph, devices: KnownDevices, context: Context) -> Findings:
    """Report names of bridged topics that do not follow the patterns."""
    for reason in dict.fromkeys((robot.missing_parts, robot.unread_plugins, *launch.unread)):
        if reason:
            yield unchecked(reason)
    of_robot = channels(robot, context.release)
    known = {topic: channel for channel in of_robot for topic in channel.topics}
    only = _only_3d_lidar(robot)
    of_depth: dict[Sensor, list[Bridge]] = {}
    for bridge in launch.bridges:
        # The args of a template give the start of a name, not the rest.
        if bridge.node.assumed_from or "$(" in bridge.ros_topic:
            continue
        channel = known.get(comparable(bridge.ign_topic))
        faults = [*_faults(bridge, channel)] or [*_by_device(bridge, channel, devices)]
        for fault in faults:
            yield finding(bridge, fault)
        if channel is None or not isinstance(channel.owner, Sensor):
            continue
        if not faults and channel.owner is only and channel.what == "points":
            yield from _words_in_front(bridge)
        if channel.owner.kind is SensorType.DEPTH_CAMERA:
            of_depth.setdefault(channel.owner, []).append(bridge)
    for sensor, bridges in of_depth.items():
        yield from _differing_prefixes(sensor, bridges)


def _faults(bridge: Bridge, channel: Channel | None) -> Iterator[str]:
    name = _name(bridge)
    of_gazebo = _is_of_gazebo(bridge)
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


def _name(bridge: Bridge) -> str:
    """Return a topic's name below the robot's namespace."""
    return bridge.ros_topic.removeprefix(_NAMESPACE)[:_LONGEST]


def _is_of_gazebo(bridge: Bridge) -> bool:
    return comparable(bridge.ros_topic) == comparable(bridge.ign_topic)


def _by_device(bridge: Bridge, channel: Channel | None, devices: KnownDevices) -> Iterator[str]:
    """Yield a fault if a camera or lidar is called by its device alone."""
    sensor = None if channel is None else channel.owner
    if not isinstance(sensor, Sensor) or _is_of_gazebo(bridge):
        return
    if not sensor.kind.takes_pictures and not sensor.kind.is_lidar:
        return
    words = spaced(_name(bridge)).lower()
    match = _DEVICE.search(words)
    device = devices.find_in_text(words)
    if (match is None and device is None) or _PLACE.search(words):
        return
    called = match.group() if match is not None else device.name if device is not None else ""
    yield (
        f"ROS topic {_name(bridge)!r} names the device ({called}), expected the place of the sensor"
    )


def _only_3d_lidar(robot: Robot) -> Sensor | None:
    lidars = [s for s in robot.sensors if class_of_sensor(s) is LidarClass.VOLUME]
    return lidars[0] if len(lidars) == 1 else None


def _words_in_front(bridge: Bridge) -> Findings:
    """Report points of a robot's only 3D lidar that have more than that name."""
    name = _name(bridge)
    if name != "points":
        yield finding(
            bridge,
            f"points of the robot's only 3D lidar are {name!r} in ROS, 'points' on most robots",
            severity=Severity.INFO,
        )


def _differing_prefixes(sensor: Sensor, bridges: Sequence[Bridge]) -> Findings:
    """Report topics of a depth camera whose words in front differ from those of the others."""
    named = {bridge: _DATA.search(_name(bridge)) for bridge in bridges}
    fronts = {
        bridge: _name(bridge)[: match.start()]
        for bridge, match in named.items()
        if match is not None and match.start()
    }
    counted = Counter(fronts.values())
    if len(counted) < 2:
        return
    usual = max(counted, key=lambda front: (counted[front], front == sensor.name.value))
    first = next(bridge for bridge, front in fronts.items() if front == usual)
    for bridge, front in fronts.items():
        if front != usual:
            yield finding(
                bridge,
                f"{sensor.type.value} {sensor.name.value!r} has topics below {usual!r} and "
                f"{_name(bridge)!r} in ROS, expected the same prefix for all",
                related=[(first, "another of its topics")],
            )


_TOPICS = "launch/vehicle_topics.launch"
_PREFIX = "/world/w/model/m/link/base_link/sensor/front"


def _bridge(topic: str, name: str) -> str:
    mark = "  <!-- ^ ROS005 -->" if name.startswith("MARK ") else ""
    return f"""<node pkg="ros_ign_image" type="image_bridge" name="bridge"
  args="{_PREFIX}/{topic}">{mark}
  <remap from="{_PREFIX}/{topic}" to="{name.removeprefix("MARK ")}"/>
</node>"""


def _launch(*bridges: str, namespace: str = "$(arg name)") -> str:
    args = '<arg name="name"/><arg name="world_name"/>'
    return "\n".join(
        ("<launch>", args, f'<group ns="{namespace}">', *bridges, "</group>", "</launch>", "")
    )


def _robot(
    name: str, *, kind: str = "camera", topic: str = "image", namespace: str = "$(arg name)"
) -> dict[str, str]:
    return {
        "@fragment": f'<sensor name="front" type="{kind}"/>',
        _TOPICS: _launch(_bridge(topic, name), namespace=namespace),
    }


def _depth(image: str, points: str, kind: str = "depth_camera") -> dict[str, str]:
    behind = "depth_image/points" if kind == "depth_camera" else "points"
    return {
        "@fragment": f'<sensor name="front" type="{kind}"/>',
        _TOPICS: _launch(_bridge("depth_image", image), _bridge(behind, points)),
    }


def _lidars(name: str, count: int = 1) -> dict[str, str]:
    scan = "<lidar><scan><vertical><samples>16</samples></vertical></scan></lidar>"
    names = ("front", "rear")[:count]
    sensors = (f'<sensor name="{each}" type="gpu_lidar">{scan}</sensor>' for each in names)
    return {"@fragment": "".join(sensors), _TOPICS: _launch(_bridge("scan/points", name))}


GOOD = [
    _robot("camera_front/image_raw"),
    _robot("front/left/image_raw"),
    _robot("background/image_raw"),
    _robot("rgbd_front/depth/image_raw", kind="rgbd_camera", topic="depth_image"),
    _robot("scan_front", kind="gpu_lidar", topic="scan"),
    _robot("gimbal/imu/data", kind="imu", topic="imu"),
    _robot("front_d435/image_raw"),
    _robot("background360/image_raw"),
    _robot("cam360/image_raw"),
    _depth("front/depth", "front/depth/points"),
    _depth("front/depth", "rgbd_front/depth/points", kind="rgbd_camera"),
    _lidars("points"),
    _lidars("front_laser/points", count=2),
]
BAD = [
    _robot("MARK camera_back/image_raw"),
    _robot("MARK rs_front/image_raw"),
    _robot("MARK d435i/image_raw"),
    _robot("MARK realsense/image_raw"),
    _robot("MARK tim571_scan", kind="gpu_lidar", topic="scan"),
    _robot("MARK hokuyo_scan", kind="gpu_lidar", topic="scan"),
    _robot("MARK bpearl/points", kind="gpu_lidar", topic="scan/points"),
    _depth("MARK top/depth", "front/depth/points"),
    _lidars("MARK front_laser/points"),
    _robot("MARK front/picture"),
    _robot("MARK front/image_raw", namespace="/"),
    _robot("MARK inertia", kind="imu", topic="imu"),
    _robot("MARK front_laser", kind="gpu_lidar", topic="scan"),
    _robot(f"MARK {_PREFIX}/image"),
]
