"""Measured facts about the new model, for the sheet, the spawner and the example world."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator

from checker.base.record import Record
from checker.model.components import Sensor
from checker.model.geometry.boxes import Box
from checker.model.geometry.placed_shapes import place_shapes, union
from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType

_ABOVE_GROUND = 0.05
"""Metres that a robot falls when it is spawned."""
_STANDING = 0.003
"""Metres between the ground and a robot that is in a world from the start."""
_DIGITS = 4
_NARROW = math.radians(30)


class Facts(Record):
    """Figures as texts write them.

    Attributes:
        mass: Kilograms.
        size: Length, width and height in metres; empty if a part's extent is not known.
        spawn_height: Added to z when the robot is spawned, metres.
        standing_height: z of a robot that stands on the ground, metres.
        sensors: The number of each kind: `3D lidar`, modeled by `gpu_lidar`.
    """

    mass: str
    size: tuple[str, ...]
    spawn_height: str
    standing_height: str
    sensors: tuple[tuple[str, str, int], ...]

    @property
    def description(self) -> str:
        """The sensors as the end of a sentence."""
        counted = [
            f"{number} {kind}{'s' if number > 1 else ''}" for kind, _, number in self.sensors
        ]
        return ", ".join(counted)


def facts_of(robot: Robot) -> Facts:
    """Measure a robot whose meshes are available."""
    box = _box(robot, visuals_too=True)
    size: tuple[str, ...] = ()
    if box is not None:
        size = tuple(f"{b - a:.2f}" for a, b in zip(box.low, box.high, strict=True))
    solid = _box(robot, visuals_too=False)
    reach = max(-solid.low[2], 0.0) if solid is not None else 0.0
    return Facts(
        f"{robot.mass:.4g}" if math.isfinite(robot.mass) else "TODO",
        size,
        f"{math.ceil((reach + _ABOVE_GROUND) * 100) / 100:g}",
        f"{round(reach + _STANDING, _DIGITS):g}",
        tuple(_counted(robot)),
    )


def sensor_lines(facts: Facts) -> Iterator[str]:
    """Yield the items of the sheet's list; the device is for the author to name."""
    for kind, model, number in facts.sensors:
        plugins = f"the `{model}` plugin" if number == 1 else f"{number} `{model}` plugins"
        plural = "s" if number > 1 else ""
        yield f"{number}x {kind}{plural}: TODO device and datasheet, modeled by {plugins}."


def _counted(robot: Robot) -> Iterator[tuple[str, str, int]]:
    kinds = Counter((_kind(sensor), sensor.type.value) for sensor in robot.sensors)
    for (kind, model), number in kinds.items():
        if kind:
            yield kind, model, number


def _kind(sensor: Sensor) -> str:
    lidar = sensor.lidar
    if sensor.kind.is_lidar and lidar is not None:
        if lidar.horizontal.angle < _NARROW:
            return "point lidar"
        return "3D lidar" if lidar.vertical.samples.value > 1.0 else "planar lidar"
    return _KINDS.get(sensor.kind, "")


_KINDS = {
    SensorType.RGBD_CAMERA: "RGBD camera",
    SensorType.CAMERA: "colour camera",
    SensorType.DEPTH_CAMERA: "depth camera",
    SensorType.THERMAL_CAMERA: "thermal camera",
    SensorType.IMU: "IMU",
    SensorType.MAGNETOMETER: "magnetometer",
    SensorType.AIR_PRESSURE: "barometer",
    SensorType.ALTIMETER: "altimeter",
    SensorType.GPU_LIDAR: "lidar",
}


def _box(robot: Robot, *, visuals_too: bool) -> Box | None:
    return union(
        piece.box
        for link in robot.links
        for piece in place_shapes(
            robot, link, (*link.collisions, *(link.visuals if visuals_too else ()))
        )
    )
