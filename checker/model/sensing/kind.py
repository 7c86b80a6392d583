"""Kinds of sensors: the meaning of the type of a `<sensor>`, in the spelling of any release."""

from __future__ import annotations

import enum
from functools import cache

from checker.base.record import Record
from checker.base.resources import table
from checker.source.text import Located
from checker.source.xml import Element

# Which types of sensors a release of Gazebo knows, and which of them it simulates.


_ELSEWHERE = frozenset({"lidar", "custom"})
"""Left out of the lost ones: a lidar of the CPU has its twin on the GPU, custom ones a plugin."""


class SensorTypes(Record):
    """Types of sensors as they are written.

    Attributes:
        known: The types that SDFormat reads.
        lost: The types that it reads and nothing simulates; empty if no release is aimed at.
    """

    known: frozenset[str]
    lost: frozenset[str]


@cache
def sensor_types(release: str) -> SensorTypes:
    """Return the types of a release; for one without a table, whatever any release knows."""
    if release == "classic":
        classic = table("gazebo_classic_ros2")
        made, lost_types = frozenset(classic["sensors"]), frozenset(classic["not_made"])
        return SensorTypes(made | lost_types, lost_types)
    releases = table("gazebo_sensors")["releases"]
    listed = [releases[release]] if release in releases else list(releases.values())
    entries = [entry for row in listed for entry in row["types"]]
    lost = [
        entry for entry in entries if not entry["simulated"] and entry["type"] not in _ELSEWHERE
    ]
    return SensorTypes(
        _spellings(entries) | {"none"},
        _spellings(lost) | {"none"} if release in releases else frozenset(),
    )


class FrameIds(Record):
    """Elements of a sensor that name the frame of its messages, in a release.

    Attributes:
        read: Those that the release reads; the first that is there counts.
        deprecated: Those of them that libsdformat warns about.
        others: Those of other releases.
    """

    read: tuple[str, ...]
    deprecated: frozenset[str]
    others: frozenset[str]


@cache
def frame_ids(release: str) -> FrameIds | None:
    """Return the elements of a release; None for one of which they are not known."""
    known = table("gazebo_sensors")["frame_ids"]
    if release not in known:
        return None
    read = tuple(known[release]["read"])
    every = {tag for entry in known.values() for tag in entry["read"]}
    return FrameIds(read, frozenset(known[release]["deprecated"]), frozenset(every - set(read)))


def frame_elements(release: str) -> tuple[str, ...]:
    """Return the elements of any release that name the frame; those that this one reads first."""
    known = frame_ids(release)
    first = (*known.read, *sorted(known.others)) if known is not None else ()
    return tuple(dict.fromkeys((*first, "gz_frame_id", "ignition_frame_id", "frame_id")))


_CAMERA_INFO_ONLY = ("citadel", "dome", "fortress")
"""Releases that write the optical frame into camera_info only."""


def stated_frame(sensor: Element, release: str) -> Located[str] | None:
    """Return the frame that a sensor states, in the spelling of whichever release.

    From Garden on, the messages of a camera are in its `<optical_frame_id>`, if it has one.
    """
    camera = sensor.child("camera") if release not in _CAMERA_INFO_ONLY else None
    optical = camera.child("optical_frame_id") if camera is not None else None
    if optical is not None and optical.text.value.strip():
        return optical.text
    for name in frame_elements(release):
        child = sensor.child(name)
        if child is not None and child.text.value.strip():
            return child.text
    return None


def frame_of(link: str) -> str:
    """Return the frame of a link: tf2 removes one slash in front."""
    return link.removeprefix("/")


def _spellings(entries: list[dict[str, list[str]]]) -> frozenset[str]:
    return frozenset(spelling for entry in entries for spelling in entry["spellings"])


class SensorType(enum.StrEnum):
    """Type of a `<sensor>`. A member's value is its type's newest spelling in SDFormat."""

    CAMERA = "camera"
    WIDE_ANGLE_CAMERA = "wide_angle_camera"
    DEPTH_CAMERA = "depth_camera"
    RGBD_CAMERA = "rgbd_camera"
    THERMAL_CAMERA = "thermal_camera"
    LOGICAL_CAMERA = "logical_camera"
    GPU_LIDAR = "gpu_lidar"
    CPU_LIDAR = "lidar"
    IMU = "imu"
    MAGNETOMETER = "magnetometer"
    NAVSAT = "navsat"
    AIR_PRESSURE = "air_pressure"
    ALTIMETER = "altimeter"
    CONTACT = "contact"
    OTHER = "other"

    @property
    def takes_pictures(self) -> bool:
        """True if it renders images, as described by a `<camera>`."""
        return self in _PICTURES

    @property
    def sees_colours(self) -> bool:
        """True if it renders colour images."""
        return self in (SensorType.CAMERA, SensorType.WIDE_ANGLE_CAMERA, SensorType.RGBD_CAMERA)

    @property
    def measures_depth(self) -> bool:
        """True if it renders images of distances."""
        return self in (SensorType.DEPTH_CAMERA, SensorType.RGBD_CAMERA)

    @property
    def is_lidar(self) -> bool:
        """True if it measures ranges along rays."""
        return self in (SensorType.GPU_LIDAR, SensorType.CPU_LIDAR)


_PICTURES = frozenset(
    {
        SensorType.CAMERA,
        SensorType.WIDE_ANGLE_CAMERA,
        SensorType.DEPTH_CAMERA,
        SensorType.RGBD_CAMERA,
        SensorType.THERMAL_CAMERA,
    }
)


def sensor_type(text: str) -> SensorType:
    """Return what a sensor's type means; `OTHER` for one that is unknown or of no concern."""
    return _types().get(text, SensorType.OTHER)


@cache
def _types() -> dict[str, SensorType]:
    members = {member.value: member for member in SensorType}
    releases = table("gazebo_sensors")["releases"].values()
    return {
        spelling: members[entry["type"]]
        for release in releases
        for entry in release["types"]
        for spelling in entry["spellings"]
        if entry["type"] in members
    }
