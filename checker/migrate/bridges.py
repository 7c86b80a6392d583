"""The bridges to ROS of a robot: one for each topic of its sensors, drive and battery."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from checker.base.record import Record
from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType
from checker.ros.topics import Channel, sensor_channels

_RELEASE = "dome"
_ANY_ROBOT = "/world/*/model/*/"
_ROBOT = "/world/$(arg world_name)/model/$(arg name)/"
_SIDES = ("front", "left", "rear", "right")
_STEEP = 0.8
"""Sine of the angle from which on a sensor looks up or down."""
_NARROW = math.radians(30)
"""Greatest angle of a lidar that measures one distance."""


class Bridge(Record):
    """A node that passes one topic on.

    Attributes:
        name: The name of the node.
        ign_topic: The topic in Gazebo.
        ros_topic: The topic below the robot's namespace.
        args: The arguments of the node: the topic, for all but pictures with the types on both
            sides.
        picture: Whether image_bridge passes it on.
        depth: Whether it is a picture of distances.
        info_topic: The topic of camera_info for a colour picture.
    """

    name: str
    ign_topic: str
    ros_topic: str
    args: str
    picture: bool = False
    depth: bool = False
    info_topic: str = ""

    @property
    def optical_topic(self) -> str:
        """Topic of the image in its optical frame: `front/optical/image_raw`."""
        return _optical(self.ros_topic)

    @property
    def optical_info_topic(self) -> str:
        """The same for its camera_info."""
        return _optical(self.info_topic)


class SensorBridges(Record):
    """Bridges of one sensor.

    Attributes:
        sensor: Its name.
        kind: Its kind, for a comment.
        bridges: One for each topic.
        rate_topic: The topic below which its rate can be set; empty for sensors without pictures.
    """

    sensor: str
    kind: str
    bridges: tuple[Bridge, ...]
    rate_topic: str = ""

    @property
    def ign_prefix(self) -> str:
        """The prefix of its topics in Gazebo."""
        before, own, _ = self.bridges[0].ign_topic.rpartition(f"/sensor/{self.sensor}")
        return before + own


def sensor_bridges(robot: Robot) -> list[SensorBridges]:
    """Return the bridges of all sensors whose data has a place in ROS."""
    taken: set[str] = set()
    bridged = []
    for sensor in robot.sensors:
        published = sensor_channels(sensor, _RELEASE)
        channels = [channel for channel in published if _is_wanted(sensor, channel)]
        if not channels:
            continue
        base = _free(_ros_base(robot, sensor), taken)
        bridges = tuple(_bridges(sensor, channels, base))
        pictures = base if sensor.kind.takes_pictures else ""
        name = sensor.name.value
        bridged.append(SensorBridges(name, sensor.type.value.replace("_", " "), bridges, pictures))
    return bridged


def _is_wanted(sensor: Sensor, channel: Channel) -> bool:
    """Return whether a channel is bridged: the scan of a lidar of one row, else the points."""
    if not channel.ros_types:
        return False
    if sensor.kind.is_lidar:
        lidar = sensor.lidar
        rows = lidar.vertical.samples.value if lidar is not None else 1.0
        return (channel.what == "points") == (rows > 1.0)
    return True


def _bridges(sensor: Sensor, channels: Sequence[Channel], base: str) -> Iterator[Bridge]:
    node = base.replace("/", "_")
    for channel in channels:
        topic = channel.topics[0].replace(_ANY_ROBOT, _ROBOT)
        ros = _ros_topic(sensor, channel, base)
        if channel.ros_types[0] == "sensor_msgs/Image":
            depth = channel.what == "depth image"
            name = f"ros_ign_image_{node}{'_depth' if depth else ''}"
            info = f"{base}/camera_info" if sensor.kind.sees_colours and not depth else ""
            yield Bridge(name, topic, ros, topic, True, depth, info)
            continue
        ending = _ENDINGS.get(channel.what, "") if sensor.kind.takes_pictures else ""
        name = f"ros_ign_bridge_{node}{ending}"
        types = f"@{channel.ros_types[0]}[{channel.ign_types[0]}"
        yield Bridge(name, topic, ros, topic + types)


_ENDINGS = {"camera_info": "_info", "points": "_points"}
"""Endings of the names of cameras' nodes, by what they relay."""


def _ros_topic(sensor: Sensor, channel: Channel, base: str) -> str:
    """Return the topic in ROS: the names that robots of SubT have in common."""
    if not sensor.kind.takes_pictures:
        return base
    return {
        "image": f"{base}/image_raw",
        "depth image": f"{base}/depth",
        "camera_info": f"{base}/camera_info",
        "points": f"{base}/depth/points",
    }.get(channel.what, f"{base}/{channel.what.replace(' ', '_')}")


def _ros_base(robot: Robot, sensor: Sensor) -> str:
    where = _looks(robot, sensor)
    if sensor.kind in _NAMES:
        return _NAMES[sensor.kind].format(where=where)
    if sensor.kind.is_lidar:
        return _lidar_topic(sensor, where)
    return f"camera_{where}" if sensor.kind.takes_pictures else sensor.name.value


_NAMES = {
    SensorType.IMU: "imu/data",
    SensorType.MAGNETOMETER: "magnetic_field",
    SensorType.AIR_PRESSURE: "air_pressure",
    SensorType.RGBD_CAMERA: "rgbd_{where}",
    SensorType.THERMAL_CAMERA: "thermal_camera",
}
"""Names that robots of SubT have in common."""


def _lidar_topic(sensor: Sensor, where: str) -> str:
    lidar = sensor.lidar
    if lidar is None or lidar.vertical.samples.value <= 1.0:
        return f"{where}_scan"
    return "points" if lidar.horizontal.angle > _NARROW else f"{where}_points"


def _looks(robot: Robot, sensor: Sensor) -> str:
    """Return which way a sensor looks: front, left, rear, right, top or bottom."""
    link = robot.links_by_name.get(sensor.link)
    pose = None if link is None else robot.pose_of_part(link, sensor.pose)
    if pose is None:
        return "front"
    x, y, z = pose.rotate((1.0, 0.0, 0.0))
    if abs(z) > _STEEP:
        return "top" if z > 0.0 else "bottom"
    return _SIDES[round(math.atan2(y, x) / (math.pi / 2)) % len(_SIDES)]


def _free(base: str, taken: set[str]) -> str:
    """Return a topic that no sensor has yet: `points`, `points_2`, `imu_2/data`."""
    first, slash, rest = base.partition("/")
    name, number = base, 2
    while name in taken:
        name, number = f"{first}_{number}{slash}{rest}", number + 1
    taken.add(name)
    return name


def _optical(topic: str) -> str:
    folder, _, name = topic.rpartition("/")
    return f"{folder}/optical/{name}"
