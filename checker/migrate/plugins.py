"""Plugins of Gazebo 9 and joints that its controllers held: what takes their place."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from lxml import etree

from checker.base.cache import NO_CACHE
from checker.base.record import Record
from checker.convert.conversion import CarriedPlugin, Conversion
from checker.convert.xml_writer import number, numbers
from checker.engine.subject import Subject
from checker.migrate import sensor_forms as forms
from checker.migrate.source import Source
from checker.migrate.xml_parts import build, number_at, put
from checker.model.geometry.transform import Transform
from checker.model.plugin_library import (
    SUBT_RELEASE,
    classic_plugin,
    library_stem,
    plugin_libraries,
)
from checker.model.robot import Robot
from checker.ros.control.controllers import Controller, ControlSystem

# Joints that position controllers held in Gazebo 9, and that a system of Ignition holds now.


_KIND = "JointPositionController"
_UNFIT = re.compile(r"\W+", re.ASCII)


class Servo(Record):
    """A JointPositionController.

    Attributes:
        joint: The joint that it holds.
        topic: The topic below the robot's name.
        p: N·m/rad (or N/m).
        i: N·m/(rad·s).
        d: N·m·s/rad.
        effort: Greatest effort, N·m or N; 0 for none.
    """

    joint: str
    topic: str
    p: float
    i: float
    d: float
    effort: float


def servos_of(source: Source, robot: Robot) -> list[Servo]:
    """Return the joints of the new robot that the source's controllers hold at a position."""
    if source.package.only:
        return []
    subject = Subject(source.package, NO_CACHE)
    try:
        control = subject.one(ControlSystem)
    finally:
        subject.close()
    if not isinstance(control, ControlSystem):
        return []
    servos: dict[str, Servo] = {}
    for joint, gains in _gains(control.controllers):
        own = robot.joints_by_name.get(joint)
        if own is None or not own.axes or joint in servos:
            continue
        effort = own.axes[0].effort.value
        limit = effort if math.isfinite(effort) and effort > 0.0 else 0.0
        topic = _UNFIT.sub("_", joint) + "_cmd"
        servos[joint] = Servo(joint, topic, gains["p"], gains["i"], gains["d"], limit)
    return list(servos.values())


def _gains(controllers: Iterable[Controller]) -> Iterator[tuple[str, dict[str, float]]]:
    """Yield joints with their gains."""
    for controller in controllers:
        if controller.kind != _KIND:
            continue
        for joint, gains in controller.gains.items():
            values = {name: gains[name].value if name in gains else 0.0 for name in "pid"}
            known = {
                name: 0.0 if x is None or not math.isfinite(x) else x for name, x in values.items()
            }
            yield joint.rpartition("/")[2], known


_BODY_TAGS = ("frameId", "frameName", "frame_id", "bodyName", "body_name", "linkName")


@dataclass
class Judged:
    """Results of the migration of plugins.

    Attributes:
        notes: Sentences, each with the file and line of the plugin.
        open_points: The replacements that the author has to add.
        drives: Plugins that drove the robot, for what they state about its wheels.
    """

    notes: list[str] = field(default_factory=list)
    open_points: list[str] = field(default_factory=list)
    drives: list[CarriedPlugin] = field(default_factory=list)


def judge_plugins(conversion: Conversion, base: str) -> Judged:
    """Remove the plugins of Gazebo 9 that are outside sensors; put sensors where they made some.

    Plugins within sensors are left: the result of their sensor depends on them.

    Args:
        conversion: Its tree is changed.
        base: Name of the link that carries the others.
    """
    judged = Judged()
    for carried in conversion.plugins:
        filename = carried.plugin.filename.value
        where = f"{carried.plugin.span.place()}: {filename}"
        if library_stem(filename) in plugin_libraries(SUBT_RELEASE):
            continue
        known = classic_plugin(filename)
        judged.notes.append(f"{where} {_what_becomes_of(known)}")
        if carried.sensor:
            continue
        if known is None:
            judged.open_points.append(f"a replacement for {filename}, whose purpose is not known")
        elif system := _system_to_add(known):
            judged.open_points.append(f"{system} in launch/spawner.rb, for {filename}")
        elif known.get("action") == "replace" and not known.get("replacement"):
            hint = known.get("note", "there is no direct replacement")
            judged.open_points.append(f"a replacement for {filename}: {hint}")
        judged.notes += _replaced(known or {}, carried, conversion, base)
        instead = (known or {}).get("replacement") or {}
        if "Drive" in instead.get("name", "") or "Steering" in instead.get("name", ""):
            judged.drives.append(carried)
        carried.remove()
    judged.notes += _lights(conversion.tree)
    return judged


def _what_becomes_of(known: dict[str, Any] | None) -> str:
    if known is None:
        return "is removed: it is built for Gazebo 9, and only its author knows a replacement"
    instead = known.get("replacement") or {}
    note = f" ({known['note']})" if known.get("note") else ""
    if kind := instead.get("sensor_type"):
        return f"is replaced by a sensor of type {kind}"
    if _system_to_add(known):
        return f"is removed; its replacement is {instead['filename']}, {instead['name']}{note}"
    return f"is removed{note}"


def _system_to_add(known: dict[str, Any]) -> str:
    """Return the class of the system that replaces a plugin and that no spawner gets unasked."""
    name = str((known.get("replacement") or {}).get("name", ""))
    return "" if name.rpartition("::")[2] in _WRITTEN else name


_WRITTEN = frozenset(
    {"DiffDrive", "AckermannSteering", "PosePublisher", "WheelSlip", "LinearBatteryPlugin"}
)
"""Systems that the new spawner has where they fit."""


def _replaced(
    known: dict[str, Any], carried: CarriedPlugin, conversion: Conversion, base: str
) -> Iterator[str]:
    """Put the sensor that a plugin made into the model."""
    kind = (known.get("replacement") or {}).get("sensor_type")
    if kind == "rgbd_camera":
        yield from _merged(carried, conversion.tree)
    elif kind in ("imu", "magnetometer", "air_pressure"):
        link, pose = _body(carried, conversion, base)
        holder = _link(conversion.tree, link)
        if holder is not None:
            name = _free_name(holder, _SENSOR_NAMES[kind])
            holder.append(_new_sensor(name, kind, pose, _rate_of(carried.node, kind)))
            place = numbers(pose.translation)
            yield f"sensor {name!r} of type {kind} is in link {link!r} at {place}"
    elif kind is not None:
        yield f"{carried.plugin.filename.value} is not in a sensor, so no sensor can replace it"


_SENSOR_NAMES = {
    "imu": "imu_sensor",
    "magnetometer": "magnetometer",
    "air_pressure": "air_pressure",
}


def _body(carried: CarriedPlugin, conversion: Conversion, base: str) -> tuple[str, Transform]:
    """Return the link that carries what a plugin measures, and the place of it in that link."""
    texts = [carried.node.findtext(tag) or "" for tag in _BODY_TAGS]
    for name in (*texts, carried.reference):
        lumped = conversion.lumped.get(name.strip().rpartition("/")[2])
        if lumped is not None:
            return lumped.link, lumped.pose
    return carried.link or base, Transform()


def _link(tree: etree._Element, name: str) -> etree._Element | None:
    return next((link for link in tree.iter("link") if link.get("name") == name), None)


def _free_name(link: etree._Element, name: str) -> str:
    taken, number_ = {sensor.get("name") for sensor in link.iterfind("sensor")}, 2
    unique = name
    while unique in taken:
        unique, number_ = f"{name}_{number_}", number_ + 1
    return unique


def _rate_of(plugin: etree._Element, kind: str) -> float:
    rates = (number_at(plugin, tag, 0.0) for tag in ("updateRate", "updateRateHZ"))
    return next((rate for rate in rates if rate > 0.0), forms.usual_rate(kind))


def _new_sensor(name: str, kind: str, pose: Transform, rate: float) -> etree._Element:
    content = {
        "@name": name,
        "@type": kind,
        "pose": f"{numbers(pose.translation)} {numbers(pose.rpy)}",
        "update_rate": number(rate),
    }
    return build("sensor", content)


def _merged(carried: CarriedPlugin, tree: etree._Element) -> Iterator[str]:
    """Make one sensor of the cameras that a RealSense plugin joins."""
    name = carried.plugin.filename.value
    cameras = _cameras_of(carried, tree)
    if not cameras:
        yield f"{name} names no camera of the model, so no camera can replace it"
        return
    kept = next((camera for camera in cameras if "color" in camera.get("name", "")), cameras[0])
    depth = next((camera for camera in cameras if camera.get("type") == "depth"), None)
    prefix = _prefix(carried) or carried.reference or kept.get("name", "")
    names = [camera.get("name", "") for camera in cameras]
    for sensor in cameras:
        parent = sensor.getparent()
        if sensor is not kept and parent is not None:
            parent.remove(sensor)
    kept.set("name", prefix.strip("_/ ") or "rgbd_camera")
    kept.set("type", "rgbd_camera")
    near = number_at(carried.node, "rangeMinDepth", 0.0)
    if near <= 0.0 and depth is not None:
        near = number_at(depth, "camera/clip/near", 0.0)
    camera = kept.find("camera")
    if camera is not None and near > 0.0:
        put(camera, "clip", {"near": near, "far": number_at(camera, "clip/far", 100.0)})
    yield f"sensors {', '.join(names)} become one rgbd_camera {kept.get('name')!r}"


def _cameras_of(carried: CarriedPlugin, tree: etree._Element) -> Sequence[etree._Element]:
    """Return the cameras that a device consists of.

    They have the plugin's prefix, are in its link, or are called by what they see.
    """
    cameras = [sensor for sensor in tree.iter("sensor") if sensor.get("type") in _LENSES]
    prefix = _prefix(carried)
    named = [camera for camera in cameras if prefix and camera.get("name", "").startswith(prefix)]
    if named:
        return named
    holder = _link(tree, carried.link) if carried.link else None
    beside = [camera for camera in cameras if holder is not None and camera.getparent() is holder]
    return beside or [camera for camera in cameras if _PARTS.search(camera.get("name", ""))]


_LENSES = ("camera", "depth", "wideanglecamera")
_PARTS = re.compile(r"(?:^|[/_])(?:colou?r|rgb|depth|i?red_?[12]|infra(?:red)?_?[12]|ir_?[12])$")
"""Ends of names of the cameras that a RealSense consists of."""


def _prefix(carried: CarriedPlugin) -> str:
    names = (carried.node.findtext(tag) or "" for tag in ("prefix", "cameraName"))
    return next((word.strip() for word in names if word.strip()), "")


def _lights(tree: etree._Element) -> Iterator[str]:
    names = [light.get("name", "") for light in tree.iter("light")]
    if names:
        yield (
            f"lights {', '.join(names)} are darker in Ignition Gazebo than in Gazebo 9: make them "
            "brighter with the values below <attenuation>"
        )
