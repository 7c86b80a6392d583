"""Sensors of Gazebo 9 rewritten: each gets the type that replaces it, and the standard's form."""

from __future__ import annotations

import copy
import re
from collections.abc import Callable, Iterator, Mapping

from lxml import etree

from checker.migrate import sensor_forms as forms
from checker.migrate.xml_parts import drop, number_at, put
from checker.model.plugin_library import classic_plugin

_BY_TYPE = {
    **dict.fromkeys(("ray", "gpu_ray", "lidar", "gpu_lidar", "sonar"), "gpu_lidar"),
    **dict.fromkeys(("depth", "depth_camera", "rgbd", "rgbd_camera"), "rgbd_camera"),
    **dict.fromkeys(("camera", "multicamera", "wideanglecamera", "wide_angle_camera"), "camera"),
    **dict.fromkeys(("thermal", "thermal_camera"), "thermal"),
    **{kind: kind for kind in ("imu", "magnetometer", "air_pressure", "altimeter", "contact")},
    "logical_camera": "logical_camera",
}
"""Replacements of sensor types; types that are missing have none."""
_FORMS: Mapping[str, Callable[[etree._Element], None]] = {
    "camera": forms.as_camera,
    "gpu_lidar": forms.as_lidar,
    "imu": forms.as_imu,
    "magnetometer": forms.as_magnetometer,
    "air_pressure": forms.as_air_pressure,
}
_UNFIT = re.compile(r"[^\w.+-]")
"""Characters that are not allowed in names of topics and launch files."""
_NAME_LIMIT = 100
_CONE = 0.26
"""Radians, of a sonar that does not state it."""


def rewrite_sensors(tree: etree._Element) -> list[str]:
    """Rewrite every sensor of a model in place; return what was done, as sentences."""
    notes: list[str] = []
    for sensor in list(tree.iter("sensor")):
        for single in _singles(sensor, notes):
            notes += _rewritten(single)
    _name_apart(tree)
    return notes


def _singles(sensor: etree._Element, notes: list[str]) -> list[etree._Element]:
    """Part a camera of several lenses into one sensor for each."""
    cameras = sensor.findall("camera")
    if len(cameras) < 2:
        return [sensor]
    parent, parts = sensor.getparent(), []
    if parent is None:
        return [sensor]
    for number, camera in enumerate(cameras, 1):
        part = copy.deepcopy(sensor)
        drop(part, "camera")
        own = copy.deepcopy(camera)
        part.append(own)
        part.set("name", f"{sensor.get('name', 'camera')}_{camera.get('name') or number}")
        parent.insert(parent.index(sensor), part)
        parts.append(part)
    parent.remove(sensor)
    notes.append(
        f"sensor {sensor.get('name')!r} has {len(cameras)} lenses, so it becomes several cameras"
    )
    return parts


def _rewritten(sensor: etree._Element) -> Iterator[str]:
    was, name = sensor.get("type", ""), sensor.get("name", "")
    kind = _type_by_plugin(sensor) or _BY_TYPE.get(was, "")
    parent = sensor.getparent()
    if parent is None:
        return
    if not kind:
        parent.remove(sensor)
        yield f"sensor {name!r} of type {was!r} is removed: Ignition Gazebo Dome has none"
        return
    plugin = sensor.find("plugin")
    plugin = None if plugin is None else copy.deepcopy(plugin)
    rate = _rate(sensor, plugin, kind)
    drop(sensor, "plugin", "visualize", "topic", "always_on", "update_rate")
    put(sensor, "always_on", 1)
    if kind != "contact":
        put(sensor, "update_rate", rate)
    _order(sensor)
    _form(sensor, kind, plugin)
    sensor.set("type", kind)
    if kind == "gpu_lidar" and _is_range(plugin) and _one_row(sensor):
        yield (
            f"sensor {name!r} measures along one row of rays, so it publishes a LaserScan, not a "
            "Range"
        )
    if kind != was:
        yield f"sensor {name!r} of type {was!r} becomes {kind}"


def _type_by_plugin(sensor: etree._Element) -> str:
    """Return the type that the first known plugin of a sensor names; empty without one."""
    for plugin in sensor.iterfind("plugin"):
        known = classic_plugin(plugin.get("filename", "")) or {}
        if kind := str((known.get("replacement") or {}).get("sensor_type") or ""):
            return kind
    return ""


def _is_range(plugin: etree._Element | None) -> bool:
    return plugin is not None and "ros_range" in plugin.get("filename", "")


def _one_row(sensor: etree._Element) -> bool:
    """Leave one row of rays to a sensor that represents a distance; state whether it had more."""
    scan = sensor.find("lidar/scan")
    if scan is None or number_at(scan, "vertical/samples", 1.0) <= 1.0:
        return False
    drop(scan, "vertical")
    return True


def _form(sensor: etree._Element, kind: str, plugin: etree._Element | None) -> None:
    if kind == "rgbd_camera":
        near = number_at(sensor, "camera/clip/near", forms.DEPTH_NEAR)
        forms.as_rgbd_camera(sensor, near)
    elif kind == "gpu_lidar":
        if sensor.find("ray") is None and sensor.find("lidar") is None:
            near = max(number_at(sensor, "sonar/min", 0.05), 0.01)
            far = number_at(sensor, "sonar/max", 4.0)
            forms.narrow_lidar(sensor, _CONE, near, max(far, near + 1.0))
        forms.as_lidar(sensor)
        if plugin is not None:
            _take_range(sensor, plugin)
    elif kind == "thermal":
        forms.as_camera(sensor)
    elif kind in _FORMS:
        _FORMS[kind](sensor)


def _take_range(sensor: etree._Element, plugin: etree._Element) -> None:
    """Use the range of a lidar's plugin, which narrows that of its rays."""
    reach = sensor.find("lidar/range")
    if reach is None:
        return
    for tag, path in (("min", "min_range"), ("max", "max_range")):
        value = number_at(plugin, path, 0.0)
        if value > 0.0:
            put(reach, tag, value)


def _rate(sensor: etree._Element, plugin: etree._Element | None, kind: str) -> float:
    rate = number_at(sensor, "update_rate", 0.0)
    if plugin is not None and rate <= 0.0:
        tags = ("updateRate", "updateRateHZ", "hz")
        rate = next((x for tag in tags if (x := number_at(plugin, tag, 0.0)) > 0.0), 0.0)
    return rate if rate > 0.0 else forms.usual_rate(kind)


def _order(sensor: etree._Element) -> None:
    """Put what states where and how often in front."""
    for place, tag in enumerate(name for name in _FIRST if sensor.find(name) is not None):
        child = sensor.find(tag)
        if child is not None:
            sensor.insert(place, child)


_FIRST = ("pose", "always_on", "update_rate")


def _name_apart(tree: etree._Element) -> None:
    """Give each sensor of a link its own name."""
    for holder in (*tree.iter("link"), *tree.iter("joint")):
        taken: set[str] = set()
        for sensor in holder.iterfind("sensor"):
            # What is before a slash is the robot's name in Gazebo 9.
            own = _UNFIT.sub("_", (sensor.get("name") or "").rpartition("/")[2])
            name, number = own[:_NAME_LIMIT] or "sensor", 2
            unique = name
            while unique in taken:
                unique, number = f"{name}_{number}", number + 1
            sensor.set("name", unique)
            taken.add(unique)
