"""Devices that are known by name or shape: of a user's settings, then those of `devices.json`."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache, lru_cache
from typing import Any

from msgspec.structs import replace

from checker.base.record import Record
from checker.base.resources import table
from checker.model.devices.devices import Device
from checker.model.devices.form import expression
from checker.model.sensing.lidar import Lidar

TEXT_LIMIT = 500
"""Characters of a text that are searched for names of devices."""
_JOINTS = re.compile(r"[_/:.]+")


class KnownDevices(Record, eq=False):
    """Devices of which figures are known.

    Attributes:
        devices: The first one whose name is in a text is meant.
    """

    devices: tuple[Device, ...]

    def find_in_text(self, text: str, types: Iterable[str] | None = None) -> Device | None:
        """Return the device that running text names; None if it names none, or several.

        Args:
            text: Its first 500 characters count.
            types: Types of `<sensor>`; devices that none of them may represent do not count.
        """
        named = self.find_all_in_text(text, types)
        return named[0] if len(named) == 1 else None

    def find_all_in_text(self, text: str, types: Iterable[str] | None = None) -> list[Device]:
        """Return all devices that running text names; see `find_in_text`."""
        wanted = None if types is None else frozenset(types)
        named: list[tuple[Device, int, int]] = []
        for device in self.devices:
            if wanted is not None and not wanted & device.sdf_types:
                continue
            match = expression(device.match).search(text[:TEXT_LIMIT])
            if match is None:
                continue
            start, end = match.span()
            # What overlaps is another reading of the same words, and the first one counts.
            if not any(start < other_end and first < end for _, first, other_end in named):
                named.append((_of_code(device, **match.groupdict()), start, end))
        return [device for device, _, _ in named]

    def find_in_name(self, name: str, types: Iterable[str] | None = None) -> Device | None:
        """Return the device in a name such as `front_vlp16_link`; see `find_in_text`."""
        return self.find_in_text(spaced(name[:TEXT_LIMIT]), types)


@lru_cache(512)
def _of_code(device: Device, model: str = "", code: str = "") -> Device:
    """Return the device of a type code, with what its number encodes; always the same object."""
    if not model or not code:
        return device
    values = dict(device.values)
    for figure in ("megapixels", "width"):
        unit = values.pop(f"{figure}_by_code", None)
        if unit is not None:
            values[figure] = int(code) * unit
    sizes = values.pop("image_sizes_by_code", {})
    if code in sizes:
        values["image_sizes"] = sizes[code]
    return replace(
        device,
        id=f"{device.id} {model.casefold()}",
        name=f"{device.name} {model}",
        code=model,
        values=values,
    )


def spaced(name: str) -> str:
    """Return a name as its words: `front vlp16 link` for `front_vlp16_link`."""
    return _JOINTS.sub(" ", name)


def known_devices(own: Sequence[Mapping[str, Any]] = ()) -> KnownDevices:
    """Return the devices of a user, each in the form of `devices.json`, before those of ours."""
    return KnownDevices((*map(read_device, own), *_ours()))


@cache
def _ours() -> tuple[Device, ...]:
    return tuple(map(read_device, table("devices")["devices"]))


def read_device(entry: Mapping[str, Any]) -> Device:
    """Read a description in which `problem_of_device` finds nothing wrong."""
    return Device(
        entry["id"],
        entry["name"],
        entry["kind"],
        entry["match"],
        frozenset(entry["sdf_types"]),
        entry["values"],
        entry.get("body", {}),
        entry.get("source", "the settings"),
        entry.get("source_detail", {}),
    )


# Devices that have the shape of a lidar's scan: as many rows over the same angle.


def devices_of_shape(lidar: Lidar, known: KnownDevices, tolerance: float = 1.0) -> list[Device]:
    """Return the devices of several rows that scan as a lidar does.

    Args:
        lidar: The lidar as it is set.
        known: Devices of which one variant is known count.
        tolerance: Degrees.
    """
    lower, upper = vertical_degrees(lidar)
    return [
        device
        for device in known.devices
        if isinstance(device.values.get("rows"), int)
        and lidar.rows == device.values["rows"] > 1
        and "vfov_deg" in device.values
        and abs(lower - device.values["vfov_deg"][0]) <= tolerance
        and abs(upper - device.values["vfov_deg"][1]) <= tolerance
    ]


def vertical_degrees(lidar: Lidar) -> tuple[float, float]:
    """Return the angles of the lowest and the highest row, degrees."""
    return math.degrees(lidar.vertical.lower.value), math.degrees(lidar.vertical.upper.value)
