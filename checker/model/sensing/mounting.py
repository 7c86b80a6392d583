"""Where sensors are, and where they look."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.model.transform import Transform, Vector
from checker.record import record

if TYPE_CHECKING:
    from checker.model.components import Joint, Link, Sensor
    from checker.model.robot import Robot


@record(eq=False)
class Mounted:
    """A sensor in the robot's frame, with all joints where they start.

    Attributes:
        owner: The link or joint that carries it.
        pose: Of the sensor; its x axis points where a camera looks.
    """

    sensor: Sensor
    owner: Link | Joint
    pose: Transform

    @property
    def looking(self) -> Vector | None:
        """Where the middle of its view points, of length 1.

        None for what does not look (an IMU), and for lidars that look to all sides.
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
