"""Finds out which sensor of a robot represents which device.

The specification sheet's list of sensors counts most; if it has none or leaves a choice, names and
comments of the model do, then the rest of the sheet. Two different answers count as no answer:
figures must not be compared with those of another device.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence, Set

from checker.base.record import Record
from checker.model.components import Sensor
from checker.model.devices.devices import Device, SensorDevice, SensorDevices
from checker.model.devices.known import KnownDevices
from checker.model.devices.lidar_class import (
    LidarClass,
    class_of_device,
    class_of_kind,
    class_of_sensor,
)
from checker.model.devices.other_lines import NamedDevice, devices_in_other_lines
from checker.model.robot import Robot
from checker.model.specification.sensor_kinds import TYPES
from checker.model.specification.sensors import ListedSensor
from checker.model.specification.sheet import Specification
from checker.source.text import Located

SENSORS_LIMIT = 500
"""Sensors of a robot that are read; real ones have less than 50."""
PASSAGES_LIMIT = 100
_WORDS = {
    **dict.fromkeys(("front", "forward"), "front"),
    **dict.fromkeys(("rear", "back", "backward"), "rear"),
    **dict.fromkeys(("top", "up", "upward", "upper"), "top"),
    **dict.fromkeys(("bottom", "down", "downward", "lower"), "bottom"),
    "left": "left",
    "right": "right",
}
"""Words for where a sensor is or looks, and what they have in common."""


class _Item(Record, eq=False):
    """Entry of the sheet for one kind of sensors."""

    listed: ListedSensor
    device: Device | None
    types: frozenset[str]
    lidar_class: LidarClass | None
    places: frozenset[str]


class _Named(Record, eq=False):
    """Facts that the model itself states about a sensor."""

    sensor: Sensor
    device: Device | None
    words: Located[str]
    lidar_class: LidarClass | None
    places: frozenset[str]


def find_sensor_devices(
    robot: Robot, known: KnownDevices, sheet: Specification | None, configurations: Set[int]
) -> SensorDevices:
    """Return the devices that a robot's sensors represent.

    Args:
        robot: Its sensors beyond the first 500 are left out.
        known: Devices to choose from.
        sheet: None if it is not available: then the model's own words are all there is.
        configurations: Numbers of sensor configurations that the sheet may name.
    """
    sensors = [_read_sensor(sensor, known) for sensor in robot.sensors[:SENSORS_LIMIT]]
    if sheet is None:
        return SensorDevices(tuple(_decided(sensors, [])))
    items = list(_items(sheet, known, configurations))
    others = devices_in_other_lines(sheet, known, configurations)
    decided = [_of_family(device, others) for device in _decided(sensors, items)]
    decided += _by_other_lines(sensors, items, decided, others)
    section = sheet.section("diversions")
    paragraphs = section.passages[:PASSAGES_LIMIT] if section is not None else ()
    return SensorDevices(tuple(decided), tuple(paragraph.words for paragraph in paragraphs))


def _items(sheet: Specification, known: KnownDevices, configurations: Set[int]) -> Iterator[_Item]:
    for listed in sheet.sensors[:SENSORS_LIMIT]:
        types = TYPES.get(listed.kind)
        if types is None or (listed.configurations and not listed.configurations & configurations):
            continue
        # A link says it too.
        device = known.find_in_text(listed.text, types) or known.find_in_text(
            listed.span.text, types
        )
        if device is not None:
            types &= device.sdf_types
            lidar_class = class_of_device(device) or class_of_kind(listed.kind)
        else:
            lidar_class = class_of_kind(listed.kind)
        yield _Item(listed, device, types, lidar_class, _places([listed.text]))


def _read_sensor(sensor: Sensor, known: KnownDevices) -> _Named:
    comment = sensor.element.comment_in_front
    texts = [sensor.name, Located(sensor.link, sensor.span), sensor.topic]
    texts += [comment] if comment is not None else []
    device, words = None, sensor.name
    for text in texts:
        device = known.find_in_name(text.value, (sensor.type.value,))
        if device is not None:
            words = text
            break
    places = _places([sensor.name.value]) or _places([sensor.link, sensor.topic.value])
    return _Named(sensor, device, words, class_of_sensor(sensor), places)


def _places(texts: Iterable[str]) -> frozenset[str]:
    words = re.findall(r"[a-z]+", " ".join(text[:300] for text in texts).lower())
    return frozenset(_WORDS[word] for word in words if word in _WORDS)


def _decided(sensors: Sequence[_Named], items: Sequence[_Item]) -> Iterator[SensorDevice]:
    """Yield what is known of the sensors: from the sheet, else from their own words."""
    chosen = _chosen(sensors, items)
    agreed = _agreed(chosen)
    for named in sensors:
        item = chosen.get(named)
        if item is None:
            listed = any(_may_be(item, named) for item in items)
            if named.device is not None and not listed:
                yield SensorDevice(named.sensor, named.device, named.words, from_sheet=False)
        elif item.device is not None and (item in agreed or item.device is named.device):
            words = Located(item.listed.text, item.listed.span)
            yield SensorDevice(named.sensor, item.device, words, from_sheet=True)


def _chosen(sensors: Sequence[_Named], items: Sequence[_Item]) -> dict[_Named, _Item]:
    """Return the one item of the sheet that means a sensor, where there is one."""
    chosen: dict[_Named, _Item] = {}
    undecided: list[tuple[_Named, list[_Item]]] = []
    present = {named.lidar_class for named in sensors}
    for named in sensors:
        left = _narrowed(named, [item for item in items if _may_be(item, named)], present)
        if len(left) == 1:
            chosen[named] = left[0]
        elif left:
            undecided.append((named, left))
    # An item that some sensors clearly belong to is not meant by the others.
    taken = set(chosen.values())
    for named, left in undecided:
        free = [item for item in left if item not in taken]
        if len(free) == 1:
            chosen[named] = free[0]
    return chosen


def _may_be(item: _Item, named: _Named) -> bool:
    return named.sensor.type.value in item.types


def _narrowed(named: _Named, items: list[_Item], present: set[LidarClass | None]) -> list[_Item]:
    """Leave out the items that a sensor's words or rays contradict."""
    if named.device is not None:
        return [item for item in items if item.device is named.device]
    if named.lidar_class is not None:
        items = [
            item
            for item in items
            if item.lidar_class in (None, named.lidar_class) or item.lidar_class not in present
        ]
    alike = [item for item in items if item.places & named.places]
    return alike or [item for item in items if not item.places or not named.places]


def _agreed(chosen: dict[_Named, _Item]) -> set[_Item]:
    """Return the items for as many sensors as were found to belong to them.

    Where an item does not state how many, they must be set alike.
    """
    members: dict[_Item, list[_Named]] = defaultdict(list)
    for named, item in chosen.items():
        members[item].append(named)
    return {item for item, group in members.items() if _fits(item, group)}


def _fits(item: _Item, group: Sequence[_Named]) -> bool:
    count, device = item.listed.count, item.device
    if count is None:
        return len({_settings(named.sensor) for named in group}) == 1
    values = device.values if device is not None else {}
    cameras = values.get("cameras", values.get("cameras_per_device", 1))
    return len(group) in (count, count * cameras)


def _settings(sensor: Sensor) -> tuple[float, ...]:
    """Return what distinguishes devices of one type."""
    if sensor.lidar is not None:
        return (sensor.lidar.horizontal.samples.value, sensor.lidar.rows)
    if sensor.camera is not None:
        return (sensor.camera.width.value, sensor.camera.height.value)
    return ()


# What is left: cameras and lidars whose device only the rest of the sheet names.


_CODE = re.compile(r"\b(?!SDF|RGB|HD|USB|ROS)[A-Z][A-Za-z]*-?\d")
"""A designation such as `OS1`, `VLP-16` or `Mid-70`."""


def _by_other_lines(
    sensors: Sequence[_Named],
    items: Sequence[_Item],
    decided: Iterable[SensorDevice],
    others: Sequence[NamedDevice],
) -> Iterator[SensorDevice]:
    """Yield the sensors for which one device alone is named outside the list of sensors."""
    taken = {each.sensor for each in decided}
    left = [
        named
        for named in sensors
        if named.sensor not in taken and named.device is None and _is_seen_with(named.sensor)
    ]
    listed = {item.device.id for item in items if item.device is not None}
    for named in left:
        fitting = [each for each in others if _may_stand_for(each.device, named)]
        if len(fitting) != 1 or fitting[0].device.id in listed:
            continue
        alike = [other for other in left if _may_stand_for(fitting[0].device, other)]
        if len({_settings(other.sensor) for other in alike}) == 1 and not _has_other(items, named):
            yield SensorDevice(named.sensor, fitting[0].device, fitting[0].words, from_sheet=True)


def _of_family(known: SensorDevice, others: Sequence[NamedDevice]) -> SensorDevice:
    """Return the one device of a family whose type code the rest of the sheet names, if any."""
    if not known.from_sheet or known.names_the_model:
        return known
    maker = known.device.name.split()[0]
    coded = [o for o in others if o.device.code and o.device.name.split()[0] == maker]
    if len(coded) != 1 or not coded[0].device.sdf_types & known.device.sdf_types:
        return known
    return SensorDevice(known.sensor, coded[0].device, coded[0].words, from_sheet=True)


def _is_seen_with(sensor: Sensor) -> bool:
    return sensor.kind.takes_pictures or sensor.kind.is_lidar


def _may_stand_for(device: Device, named: _Named) -> bool:
    """Return whether a device is one of a sensor's class."""
    return (
        named.sensor.type.value in device.sdf_types and class_of_device(device) is named.lidar_class
    )


def _has_other(items: Sequence[_Item], named: _Named) -> bool:
    """Return whether the list names another device for a sensor, even an unknown one."""
    return any(
        _may_be(item, named)
        and item.lidar_class in (None, named.lidar_class)
        and (item.device is not None or _CODE.search(item.listed.text))
        for item in items
    )
