"""Plugin that drives a robot, and its wheels."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from checker.base.resources import table
from checker.model.components import Joint, Link, Plugin
from checker.model.locomotion.classic import classic_joints
from checker.model.plugin_library import classic_plugin, library_stem

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

_BODY_VELOCITY = {"gazebo_ros_planar_move": "planar_move", "VelocityControl": "VelocityControl"}
"""Libraries and classes of plugins that set the velocity of the whole robot, and their names."""

WING_CLASSES = ("LiftDrag", "AdvancedLiftDrag")
"""Plugin classes that give a link lift."""

_READS_ONLY = frozenset({"JointStatePublisher", "gazebo_ros_joint_state_publisher", *WING_CLASSES})
"""Plugin classes, and libraries of Gazebo Classic, that name joints and do not move them."""

_WHEEL_JOINT_TAGS = ("left_joint", "right_joint")


def body_velocity(plugin: Plugin) -> str:
    """Return the name of a plugin that sets the velocity of the whole robot; empty for others."""
    names = (library_stem(plugin.filename.value), plugin.class_name)
    return next((_BODY_VELOCITY[name] for name in names if name in _BODY_VELOCITY), "")


NO_DRIVE = "no drive detected"


def drive_name(plugins: Iterable[Plugin]) -> str:
    """Return what moves the robot, `NO_DRIVE` without a drive plugin."""
    kinds = {DRIVE_CLASSES[p.class_name] for p in plugins if p.class_name in DRIVE_CLASSES}
    return " and ".join(sorted(kinds)) or NO_DRIVE


def driven_joints(plugins: Iterable[Plugin], joints: Iterable[Joint]) -> dict[str, Plugin]:
    """Return the scoped names of the joints that plugins move, with the first plugin that does.

    A class that is not in `plugin_references.json` moves whatever joint it names. If Gazebo Classic
    does not have it either, fixed joints are excepted: it may read their pose, or replace them.
    """
    known = table("plugin_references")["plugins"]
    types = {joint.scoped_name: joint.type.value for joint in joints}
    driven: dict[str, Plugin] = {}
    for plugin in plugins:
        paths = known.get(plugin.class_name)
        if _READS_ONLY & {plugin.class_name, library_stem(plugin.filename.value)}:
            continue
        unknown = paths is None and classic_plugin(plugin.filename.value) is None
        for word in _words(plugin) if paths is None else _joints_at(plugin, paths):
            name = plugin.scoped(word)
            if name in types and not (unknown and types[name] == "fixed"):
                driven.setdefault(name, plugin)
    return driven


def _words(plugin: Plugin) -> Iterator[str]:
    for element in plugin.element.descendants():
        yield element.text.value
        yield from element.attributes.values()


def _joints_at(plugin: Plugin, paths: Mapping[str, str]) -> Iterator[str]:
    for path, kind in paths.items():
        if kind == "joint":
            yield from (named.value for named in plugin.at(path))


def find_wheels(
    links: Iterable[Link], joints: Iterable[Joint], plugins: Iterable[Plugin]
) -> Iterator[Link]:
    """Yield links that a drive plugin turns, and links that are called wheels."""
    turned = set(classic_joints(plugins))
    turned |= {
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
"""Words that make a `wheel_…` something other than a wheel."""
