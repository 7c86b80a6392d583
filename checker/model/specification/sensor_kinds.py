"""Kinds of sensors that the words of a sheet mean."""

from __future__ import annotations

import enum
import re


class SensorKind(enum.StrEnum):
    """Kind of an entry below "Sensors" in a sheet."""

    LIDAR = "lidar"
    PLANAR_LIDAR = "planar_lidar"
    POINT_LIDAR = "point_lidar"
    CAMERA = "camera"
    DEPTH_CAMERA = "depth_camera"
    RGBD_CAMERA = "rgbd_camera"
    THERMAL_CAMERA = "thermal_camera"
    IMU = "imu"
    MAGNETOMETER = "magnetometer"
    AIR_PRESSURE = "air_pressure"
    ALTIMETER = "altimeter"
    GAS = "gas"
    GPS = "gps"
    SONAR = "sonar"
    CONTACT = "contact"
    WHEEL_ODOMETRY = "wheel_odometry"
    BREADCRUMBS = "breadcrumbs"
    COMMS = "comms"
    LIGHT = "light"

    @property
    def is_sensor(self) -> bool:
        """True if a `<sensor>` or its own plugin represents it in the model."""
        return self not in _PAYLOADS


_PAYLOADS = {
    SensorKind.WHEEL_ODOMETRY,
    SensorKind.BREADCRUMBS,
    SensorKind.COMMS,
    SensorKind.LIGHT,
}
_POINT = re.compile(
    r"\bpoint\s+(?:lidar|laser)s?\b|\b(?:lidar[\s-]?lite|tf\s?mini|teraranger|vl53l\w*)\b"
    r"|\brang(?:e\s?finder|ing\s+sensor)s?\b|\bsingle[\s-](?:point|beam)\b",
    re.IGNORECASE,
)
_PLANAR = re.compile(
    r"\b(?:2d|planar|scanning)\b|\b(?:rplidar|hokuyo|lms[\s-]?\d+|tim\s?\d{3})", re.IGNORECASE
)
# The order counts: what an earlier line takes, a later one does not see (`thermal camera`).
_KINDS = tuple(
    (kind, re.compile(pattern, re.IGNORECASE))
    for kind, pattern in (
        (SensorKind.BREADCRUMBS, r"\b(?:communications?\s+)?breadcrumbs?\b|\bmotes?\b"),
        (SensorKind.WHEEL_ODOMETRY, r"\bwheel (?:odometr\w+|encoders?)\b|\bpose[-_ ]publisher\b"),
        (SensorKind.LIGHT, r"\b(?:flash)?lights?\b|\bled\b"),
        (SensorKind.COMMS, r"\bcomms?\b|\bradios?\b|\bcommunications?\b"),
        (SensorKind.GAS, r"\bgas(?:emitterdetector|detector)?\b|\bco2\b"),
        (SensorKind.THERMAL_CAMERA, r"\bthermo?(?:al|graphic)?[\s_-]?(?:cameras?)?\b|\blwir\b"),
        (SensorKind.RGBD_CAMERA, r"\brgb[\s-]?(?:&\s*)?d(?:epth)?(?:[\s_-]?cameras?)?\b"),
        (SensorKind.DEPTH_CAMERA, r"\b(?:depth|tof)[\s_-]?cameras?\b"),
        (SensorKind.LIDAR, r"\b(?:gpu_)?(?:lidar|ray|laser)s?\b|\brang(?:e\s?finder|ing)s?\b"),
        (SensorKind.CAMERA, r"\b\w*cameras?\b"),
        (SensorKind.IMU, r"\bimus?(?:_sensor)?\b"),
        (SensorKind.MAGNETOMETER, r"\bmagnetometers?\b|\bcompass\b"),
        (SensorKind.AIR_PRESSURE, r"\bair[\s_]pressure\b|\bbarometers?\b|\bpressure sensors?\b"),
        (SensorKind.ALTIMETER, r"\baltimeters?\b"),
        (SensorKind.GPS, r"\bgps\b|\bgnss\b|\bnavsat\b"),
        (SensorKind.SONAR, r"\bsonars?\b|\bultrasonic\b"),
        (SensorKind.CONTACT, r"\b(?:contact|touch|bumper)\b"),
    )
)


def kinds_in(words: str, device: str) -> tuple[SensorKind, ...]:
    """Return the kinds that words name, in order of the words.

    Args:
        words: What is searched: behind `modeled by`, or the whole item.
        device: The whole item, which states whether a lidar is planar or measures one point.
    """
    places: dict[SensorKind, int] = {}
    for kind, pattern in _KINDS:
        for match in pattern.finditer(words):
            places.setdefault(kind, match.start())
        words = pattern.sub(lambda match: " " * len(match.group()), words)
    kinds = sorted(places, key=places.__getitem__)
    return tuple(_lidar(device) if kind is SensorKind.LIDAR else kind for kind in kinds)


def _lidar(device: str) -> SensorKind:
    if _POINT.search(device):
        return SensorKind.POINT_LIDAR
    return SensorKind.PLANAR_LIDAR if _PLANAR.search(device) else SensorKind.LIDAR


# Which sensor types of SDF represent a kind of sensor that words name.


_LIDARS = frozenset({"gpu_lidar", "gpu_ray", "lidar", "ray"})
_DEPTH = frozenset({"rgbd_camera", "rgbd", "depth_camera", "depth"})
_CAMERAS = frozenset({"camera", "wideanglecamera", "wide_angle_camera"})

TYPES = {
    SensorKind.LIDAR: _LIDARS,
    SensorKind.PLANAR_LIDAR: _LIDARS,
    SensorKind.POINT_LIDAR: _LIDARS,
    SensorKind.CAMERA: _CAMERAS,
    SensorKind.DEPTH_CAMERA: _DEPTH,
    SensorKind.RGBD_CAMERA: _DEPTH,
    SensorKind.THERMAL_CAMERA: frozenset({"thermal", "thermal_camera"}),
    SensorKind.IMU: frozenset({"imu"}),
    SensorKind.MAGNETOMETER: frozenset({"magnetometer"}),
    SensorKind.AIR_PRESSURE: frozenset({"air_pressure"}),
    SensorKind.ALTIMETER: frozenset({"altimeter"}),
    SensorKind.GPS: frozenset({"gps", "navsat"}),
}
"""Types that represent a kind; kinds that plugins may represent are left out."""

SUBSTITUTES = {SensorKind.CAMERA: _DEPTH, SensorKind.DEPTH_CAMERA: _CAMERAS}
"""Types that words may mean too: a camera that also measures depth."""
