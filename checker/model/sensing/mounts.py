"""Positions of sensors, and the directions in which they look."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from itertools import combinations
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.geometry.transform import Transform, Vector

if TYPE_CHECKING:
    from checker.model.components import Joint, Link, Sensor
    from checker.model.robot import Robot


class Mounted(Record, eq=False):
    """A sensor in the robot's frame, with all joints where they start.

    Attributes:
        owner: The link or joint that carries it.
        pose: The pose of the sensor; its x axis points where a camera looks.
    """

    sensor: Sensor
    owner: Link | Joint
    pose: Transform

    @property
    def looking(self) -> Vector | None:
        """Direction of the middle of its view, of length 1.

        None for sensors without a view (an IMU), and for lidars that look to all sides.
        """
        if self.sensor.kind.takes_pictures:
            return self.pose.rotate((1.0, 0.0, 0.0))
        lidar = self.sensor.lidar
        if lidar is None or not self.sensor.kind.is_lidar:
            return None
        if not abs(lidar.horizontal.angle) < _ALL_ROUND:
            return None
        across, up = lidar.horizontal.middle, lidar.vertical.middle
        if not (math.isfinite(across) and math.isfinite(up)):
            return None
        ahead = math.cos(up)
        return self.pose.rotate((ahead * math.cos(across), ahead * math.sin(across), math.sin(up)))


_ALL_ROUND = 1.5 * math.pi - 0.1
"""Radians: scans of three quarters of a turn and more see to every side but one."""


def mounted_sensors(robot: Robot) -> Iterator[Mounted]:
    """Yield the sensors whose place is known."""
    owners: tuple[Link | Joint, ...] = (*robot.links, *robot.joints)
    for owner in owners:
        for sensor in owner.sensors:
            pose = robot.pose_of_part(owner, sensor.pose)
            if pose is not None and all(map(math.isfinite, pose.translation)):
                yield Mounted(sensor, owner, pose)


# Which way a sensor is said to look: the words front, rear, left, right, up and down in names.


_AHEAD, _BEHIND = (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)
_LEFT, _RIGHT = (0.0, 1.0, 0.0), (0.0, -1.0, 0.0)
_UP, _DOWN = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
_DIRECTIONS: dict[str, Vector] = {
    "front": _AHEAD,
    "forward": _AHEAD,
    "rear": _BEHIND,
    "back": _BEHIND,
    "backward": _BEHIND,
    "left": _LEFT,
    "right": _RIGHT,
    "up": _UP,
    "upward": _UP,
    "down": _DOWN,
    "downward": _DOWN,
}
"""In the robot's frame: x ahead, y to the left, z up."""

_TOO: dict[str, tuple[Vector, ...]] = {
    **dict.fromkeys(("top", "upper", "ceiling", "roof"), (_UP,)),
    **dict.fromkeys(("bottom", "lower", "belly", "cliff", "floor", "ground", "landing"), (_DOWN,)),
    "side": (_LEFT, _RIGHT),
}
"""Words of where a sensor is or what it looks at: it may look that way too."""

_DEVICE = re.compile(
    r"cam(?:era)?|depth|hokuyo|ir|laser|lidar|ouster|realsense|rgbd?|rs|scan(?:ner)?|sensor"
    r"|thermal|tof|velodyne"
)
_LONGEST = 200
"""Characters of a name that are read."""


class CalledDirections(Record):
    """Direction of a sensor according to a name.

    Attributes:
        word: The first word for a direction.
        source: The source of the word: `name`, `topic` or `link`.
        directions: All that its words allow, of length 1, in the robot's frame.
        sideways: Whether the name is only about left and right, which may also mean the sensor's
            place.
        tilted: Whether the name is about up and down, and not front or rear: tilts of any size.
    """

    word: str
    source: str
    directions: tuple[Vector, ...]
    sideways: bool
    tilted: bool

    def angle_to(self, looking: Vector) -> float:
        """Return the angle between a direction of length 1 and the nearest that is meant, rad."""
        return min(_angle(looking, meant) for meant in self.directions)


def called_directions(mounted: Mounted) -> CalledDirections | None:
    """Return what a sensor's name states, else its topic, else the name of a link made for it."""
    for source, text in _names(mounted):
        words = _words(text)
        directions = [word for word in words if word in _DIRECTIONS]
        if directions:
            towards = list(dict.fromkeys(_DIRECTIONS[word] for word in directions))
            others = [way for word in words for way in _TOO.get(word, ())]
            between = [mid for a, b in combinations(towards, 2) if (mid := _bisector(a, b))]
            sideways = all(way in (_LEFT, _RIGHT) for way in towards)
            tilted = not sideways and not {_AHEAD, _BEHIND}.intersection(towards)
            meant = (*towards, *others, *between)
            return CalledDirections(directions[0], source, meant, sideways, tilted)
    return None


def _names(mounted: Mounted) -> Iterator[tuple[str, str]]:
    yield "name", mounted.sensor.name.value
    yield "topic", mounted.sensor.topic.value
    link = mounted.owner.name.value
    if any(_DEVICE.fullmatch(word) for word in _words(link)):
        yield "link", link


def _words(text: str) -> list[str]:
    """Split a name at whatever is no letter, and before capitals: `frontLeft_cam2`."""
    parted = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", text[:_LONGEST])
    return re.findall(r"[a-z]+", parted.lower())


def _bisector(a: Vector, b: Vector) -> Vector | None:
    """Return the direction half way between two; None if they are opposite."""
    x, y, z = (p + q for p, q in zip(a, b, strict=True))
    length = math.hypot(x, y, z)
    return (x / length, y / length, z / length) if length > 0.0 else None


def _angle(a: Vector, b: Vector) -> float:
    cosine = sum(p * q for p, q in zip(a, b, strict=True))
    return math.acos(max(-1.0, min(1.0, cosine)))
