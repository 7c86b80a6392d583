"""Sensors in the form of Ignition Gazebo: lidars, cameras, IMUs by the SubT standard."""

from __future__ import annotations

import math

from lxml import etree

from checker.base.resources import table
from checker.convert.xml_writer import exact
from checker.migrate.xml_parts import Tree, build, drop, number_at, put

DEPTH_NEAR = 0.1
"""Metres from which depth is measured where nothing is stated."""
PICTURE_NEAR = 0.05
"""Metres from which a colour picture shows things; it hides no device that carries the camera."""
_RATES = {"imu": 50.0, "gpu_lidar": 10.0, "magnetometer": 20.0, "air_pressure": 20.0}
_PICTURE_RATE = 30.0
_SIZE = (320, 240)
"""Pixels where nothing is stated, as SDFormat has it."""
_FIELD_OF_VIEW = 1.047
"""Radians, likewise."""


def usual_rate(kind: str) -> float:
    """Return the measurements a second of a sensor that states none."""
    return _RATES.get(kind, _PICTURE_RATE)


def as_lidar(sensor: etree._Element) -> None:
    """Write `<ray>` as `<lidar>`, with the resolution and noise of the standard."""
    standard = table("subt_standards")["lidar"]
    lidar = sensor.find("lidar")
    if lidar is None:
        lidar = sensor.find("ray")
    if lidar is None:
        lidar = etree.SubElement(sensor, "lidar")
    lidar.tag = "lidar"
    for scan in lidar.iterfind("scan/*"):
        put(scan, "resolution", standard["scan_resolution"])
    reach = lidar.find("range")
    if reach is not None:
        put(reach, "resolution", standard["range_resolution"])
    put(lidar, "noise", _gaussian(standard["noise_stddev"]))


def as_camera(sensor: etree._Element) -> None:
    """Write a camera with its intrinsics, and the noise and range of the standard."""
    standard = table("subt_standards")["camera"]
    camera = _camera(sensor)
    drop(camera, "save", "distortion", "depth_camera")
    camera.set("name", sensor.get("name", "camera"))
    width = max(round(number_at(camera, "image/width", _SIZE[0])), 1)
    height = max(round(number_at(camera, "image/height", _SIZE[1])), 1)
    angle = number_at(camera, "horizontal_fov", _FIELD_OF_VIEW)
    put(camera, "horizontal_fov", exact(angle))
    put(camera, "image", {"width": width, "height": height, "format": "R8G8B8"})
    near = min(number_at(camera, "clip/near", PICTURE_NEAR), PICTURE_NEAR)
    put(camera, "clip", {"near": near, "far": standard["clip_far"]})
    put(camera, "noise", _gaussian(standard["noise_stddev"]))
    put(camera, "lens", {"intrinsics": _intrinsics(width, height, angle)})


def as_rgbd_camera(sensor: etree._Element, depth_near: float) -> None:
    """Write a camera of colour and depth.

    Args:
        sensor: The sensor to write.
        depth_near: Metres from which depth is measured.
    """
    as_camera(sensor)
    far = table("subt_standards")["rgbd"]["depth_clip_far"]
    near = depth_near if 0.0 < depth_near < far else DEPTH_NEAR
    camera = _camera(sensor)
    put(camera, "depth_camera", {"clip": {"near": near, "far": far}})


def as_imu(sensor: etree._Element) -> None:
    """Write the IMU of the standard, which keeps its orientation to itself."""
    standard = table("subt_standards")["imu"]
    content: dict[str, Tree | int] = {"enable_orientation": int(standard["enable_orientation"])}
    for quantity in ("angular_velocity", "linear_acceleration"):
        figures = {("@type" if tag == "type" else tag): x for tag, x in standard[quantity].items()}
        content[quantity] = {axis: {"noise": figures} for axis in standard["axes"]}
    put(sensor, "imu", content)


def as_magnetometer(sensor: etree._Element) -> None:
    """Write a magnetometer with the noise of the standard."""
    stddev = table("subt_standards")["magnetometer"]["noise_stddev"]
    noise: Tree = {"noise": {"@type": "gaussian", "mean": 0, "stddev": stddev}}
    put(sensor, "magnetometer", dict.fromkeys("xyz", noise))


def as_air_pressure(sensor: etree._Element) -> None:
    """Write a barometer with the noise of the standard."""
    stddev = table("subt_standards")["air_pressure"]["noise_stddev"]
    noise: Tree = {"noise": {"@type": "gaussian", "mean": 0, "stddev": stddev}}
    put(sensor, "air_pressure", {"pressure": noise})


def narrow_lidar(sensor: etree._Element, angle: float, near: float, far: float) -> None:
    """Give a sensor without rays a narrow cone of them.

    Args:
        sensor: The sensor to write.
        angle: The angle of the cone, radians.
        near: Least distance, metres.
        far: Greatest.
    """
    row = {"samples": 5, "resolution": 1, "min_angle": -angle / 2, "max_angle": angle / 2}
    scan: Tree = {"horizontal": row, "vertical": row}
    content: Tree = {"scan": scan, "range": {"min": near, "max": far, "resolution": 0.01}}
    drop(sensor, "ray", "lidar", "sonar")
    sensor.append(build("lidar", content))


def _camera(sensor: etree._Element) -> etree._Element:
    camera = sensor.find("camera")
    return etree.SubElement(sensor, "camera") if camera is None else camera


def _gaussian(stddev: float) -> Tree:
    return {"type": "gaussian", "mean": 0, "stddev": stddev}


def _intrinsics(width: int, height: int, angle: float) -> Tree:
    """Return the pinhole of an undistorted picture: f = w / (2 tan(angle / 2)), in pixels."""
    tangent = math.tan(min(max(angle, 0.01), math.pi - 0.01) / 2)
    focal = round(width / (2 * tangent), 3)
    return {"fx": focal, "fy": focal, "cx": width / 2, "cy": height / 2, "s": 0}
