"""Devices of which datasheets are known, and which sensor of a robot represents which."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cached_property
from typing import Any

from checker.base.record import Record
from checker.model.components import Sensor
from checker.model.devices.form import expression
from checker.source.text import Located

_TEXT_LIMIT = 1000
_LIDAR = r"\blidars?\b|\blasers?\b"
_CAMERA = r"\bcameras?\b|\brgb-?d\b"
_WORDS = {
    **dict.fromkeys(("lidar3d", "lidar2d", "lidar1d"), _LIDAR),
    **dict.fromkeys(("camera", "rgbd", "depth", "thermal"), _CAMERA),
    "imu": r"\bimus?\b|\binertial\b",
}
"""Words for devices by their kind."""


class Device(Record, eq=False):
    """A device, as `devices.json` or the user's settings describe it.

    Attributes:
        id: The id, such as `velodyne_vlp16`.
        name: The name as its maker calls it.
        kind: `lidar3d`, `lidar2d`, `lidar1d`, `camera`, `rgbd`, `thermal`, `imu`, …
        match: Regular expression for its name in running text, ignoring case.
        sdf_types: Types of `<sensor>` that may represent it.
        values: Figures of its datasheet; the table states what each key means.
        body: `mass_kg` and `size_mm`, where they are known.
        source: The source of its figures.
        field_sources: The same for single figures.
        code: The type code that gives its figures; empty for a device of the table itself.
    """

    id: str
    name: str
    kind: str
    match: str
    sdf_types: frozenset[str]
    values: Mapping[str, Any]
    body: Mapping[str, Any]
    source: str
    field_sources: Mapping[str, str]
    code: str = ""

    @property
    def model(self) -> str:
        """Its designation among a family of devices, `BFS-U3-16S2C`; empty for a device alone."""
        match = re.search(r"\(([A-Z][A-Z0-9-]{5,})\)$", self.name)
        return match.group(1) if match else ""

    def source_of(self, field: str) -> str:
        """Return where one figure comes from."""
        return self.field_sources.get(field, self.source)

    def is_from_memory(self, field: str) -> bool:
        """Return whether no figure was compared with a datasheet: it is for information only."""
        return self.source_of(field).startswith("general knowledge")


class SensorDevice(Record, eq=False):
    """A sensor and the device that it represents.

    Attributes:
        sensor: The sensor of the robot.
        device: What it is.
        words: The words that state it: an item of the specification sheet, else the name of the
            sensor, its link or its topic.
        from_sheet: Whether the sheet states it.
    """

    sensor: Sensor
    device: Device
    words: Located[str]
    from_sheet: bool

    @property
    def names_the_model(self) -> bool:
        """True if the name of the device excludes all others of its family: a part of the sheet."""
        text = self.words.span.source.text if self.from_sheet else self.words.value
        return self.device.model in text


class SensorDevices(Record, eq=False, dict=True):
    """The devices that a robot's sensors represent, as far as sheet and names identify them.

    Attributes:
        known: One for each sensor of which something is known.
        diversions: What the sheet states about differences from the hardware, by paragraphs.
    """

    known: tuple[SensorDevice, ...]
    diversions: tuple[str, ...] = ()

    @cached_property
    def _by_sensor(self) -> dict[Sensor, SensorDevice]:
        return {device.sensor: device for device in self.known}

    def device_of(self, sensor: Sensor) -> SensorDevice | None:
        """Return the device that a sensor represents; None if unknown."""
        return self._by_sensor.get(sensor)

    def are_diverted(self, device: Device, figure: str) -> bool:
        """Return whether the sheet states that the model differs from a device in a figure.

        Args:
            device: Its own name, or the word for its kind, is looked for.
            figure: Regular expression for words that mean the figure, ignoring case.
        """
        names = expression(f"{device.match}|{_WORDS.get(device.kind, '(?!)')}")
        meant = re.compile(figure, re.IGNORECASE)
        return any(
            names.search(diversion[:_TEXT_LIMIT]) and meant.search(diversion[:_TEXT_LIMIT])
            for diversion in self.diversions
        )
