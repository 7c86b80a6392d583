"""Which plugin drives a robot, and by which wheels."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from checker.model.components import Joint, Link, Plugin

DRIVE_CLASSES = {
    "DiffDrive": "differential or skid-steer drive",
    "AckermannSteering": "Ackermann steering",
    "TrackedVehicle": "tracks",
    "TrackController": "tracks",
    "MulticopterVelocityControl": "multicopter",
    "MecanumDrive": "mecanum drive",
    "AnymalControlPlugin": "legs",
}
"""Plugin classes that move a robot, and what a report calls that."""

_WHEEL_JOINT_TAGS = ("left_joint", "right_joint")


def drive_name(plugins: Iterable[Plugin]) -> str:
    """Return what moves the robot, `none found` without a drive plugin."""
    found = {DRIVE_CLASSES[p.class_name] for p in plugins if p.class_name in DRIVE_CLASSES}
    return " and ".join(sorted(found)) or "none found"


def find_wheels(
    links: Iterable[Link], joints: Iterable[Joint], plugins: Iterable[Plugin]
) -> Iterator[Link]:
    """Yield links that a drive plugin turns, and links that are called wheels."""
    turned = {
        joint.value
        for plugin in plugins
        if plugin.class_name in DRIVE_CLASSES
        for joint in plugin.values(*_WHEEL_JOINT_TAGS)
    }
    children = {j.scope + j.child.value for j in joints if j.scoped_name in turned}
    for link in links:
        name = link.name.value.lower()
        called_so = "wheel" in name and not any(word in name for word in _NO_WHEELS)
        if link.scoped_name in children or called_so:
            yield link


_NO_WHEELS = ("well", "mount", "hub", "cover", "guard", "steer", "arm", "suspension")
"""Words that make a `wheel_…` something beside a wheel."""
