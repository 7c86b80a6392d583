"""Hover text of a sensor: the device that it represents, its rate, what it measures."""

from __future__ import annotations

import math
from collections.abc import Iterator

from checker.base.parts import NotAvailable
from checker.base.words import count
from checker.editor.card import card, code, escaped_words
from checker.editor.figures import angle, number
from checker.engine.subject import Subject
from checker.model.components import Sensor
from checker.model.devices.devices import Device, SensorDevices
from checker.model.robot import Robot
from checker.model.sensing.camera import Camera
from checker.model.sensing.lidar import Lidar, Scan
from checker.model.sensing.noise import Noise
from checker.ros.simulated_topics import topics_of_sensors

_SHOWN = 3
"""Topics of one sensor, and sizes of pictures, that are shown."""


def sensor_card(subject: Subject, robot: Robot, sensor: Sensor, note: str = "") -> str:
    """Return what is known of a sensor of a robot, as Markdown."""
    rows = [("on", code(sensor.link)), *_device(subject, sensor)]
    rate = sensor.update_rate.value
    rows.append(("rate", f"{number(rate)} Hz" if rate else "each step of the simulation"))
    rows += [*_camera(sensor.camera)] if sensor.camera is not None else []
    rows += [*_lidar(sensor.lidar)] if sensor.lidar is not None else []
    if sensor.imu is not None and sensor.imu.noises:
        rows.append(("noise", "stated for " + ", ".join(_quantities(sensor))))
    rows.append(("topic", _topics(robot, sensor)))
    title = f"**{escaped_words(sensor.type.value)} sensor** {code(sensor.name.value)}"
    return card(title, rows, note)


def _device(subject: Subject, sensor: Sensor) -> Iterator[tuple[str, str]]:
    devices = subject.one(SensorDevices)
    known = None if isinstance(devices, NotAvailable) else devices.device_of(sensor)
    if known is None:
        return
    source = "the specification sheet" if known.from_sheet else "its name"
    yield "device", f"**{escaped_words(known.device.name)}**, as {source} says"
    yield "datasheet", "; ".join(_figures(known.device))
    if (mass := known.device.body.get("mass_kg")) is not None:
        yield "device's mass", f"{number(mass)} kg"


def _figures(device: Device) -> Iterator[str]:
    """Yield the figures of a datasheet that matter most."""
    values = device.values
    if rates := values.get("rates"):
        yield f"{', '.join(map(number, rates))} Hz"
    if isinstance(rows := values.get("rows"), int):
        yield count(rows, "row")
    if sizes := values.get("image_sizes"):
        yield ", ".join(f"{width} × {height}" for width, height in sizes[:_SHOWN])
    for name, title in (("hfov_deg", "horizontal"), ("vfov_deg", "vertical")):
        field = values.get(name)
        if isinstance(field, list) and len(field) == 2:
            yield f"{title} {number(field[0])}° to {number(field[1])}°"
        elif isinstance(field, int | float):
            yield f"{title} {number(field)}°"
    if isinstance(most := values.get("range_max"), int | float):
        least = values.get("range_min")
        start = f"{number(least)} to " if isinstance(least, int | float) else "up to "
        yield f"{start}{number(most)} m"


def _camera(camera: Camera) -> Iterator[tuple[str, str]]:
    width, height = camera.width.value, camera.height.value
    yield (
        "picture",
        f"{number(width)} × {number(height)} pixels, {escaped_words(camera.format.value)}",
    )
    field = f"horizontal {angle(camera.horizontal_fov.value)}"
    if (pinhole := camera.pinhole) is not None:
        vertical = 2.0 * math.atan(height / (2.0 * pinhole.fy))
        field += f", vertical {angle(vertical)}"
    yield "field of view", field
    yield "sees", f"{number(camera.clip.near.value)} to {number(camera.clip.far.value)} m"
    if camera.depth_clip is not None:
        near, far = camera.depth_near.value, camera.depth_far.value
        yield "measures depth", f"{number(near)} to {number(far)} m"
    yield "noise", _noise(camera.noise, "of white")


def _lidar(lidar: Lidar) -> Iterator[tuple[str, str]]:
    samples, rows = lidar.horizontal.samples.value, lidar.rows
    yield "rays", f"{number(samples)} × {number(rows)} in a scan"
    yield "horizontal", _scan(lidar.horizontal)
    if rows > 1:
        yield "vertical", _scan(lidar.vertical)
    text = f"{number(lidar.range_min.value)} to {number(lidar.range_max.value)} m"
    resolution = lidar.range_resolution.value
    yield "range", text + (f", in steps of {number(resolution)} m" if resolution else "")
    yield "noise", _noise(lidar.noise, "m")


def _scan(scan: Scan) -> str:
    low, high = (round(math.degrees(it.value), 2) for it in (scan.lower, scan.upper))
    text = f"{number(low)}° to {number(high)}°"
    if scan.samples.value > 1:
        step = math.degrees(scan.angle) / (scan.samples.value - 1)
        text += f", every {number(step)}°"
    return text


def _noise(noise: Noise | None, unit: str) -> str:
    if noise is None or noise.type.value in ("", "none"):
        return ""
    return f"{escaped_words(noise.type.value)}, deviation {number(noise.stddev.value)} {unit}"


def _quantities(sensor: Sensor) -> list[str]:
    noises = sensor.imu.noises if sensor.imu is not None else {}
    return sorted({quantity.replace("_", " ") for quantity, _ in noises})


def _topics(robot: Robot, sensor: Sensor) -> str:
    """Return the topics in Gazebo: as stated, else the default, where the names are not known."""
    shown = ", ".join(map(code, topics_of_sensors(robot)[id(sensor)][:_SHOWN]))
    return shown if sensor.topic.stated or not shown else f"{shown} by default"
