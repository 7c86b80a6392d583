"""Reads the drive of a robot from its plugins."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.model.components import Joint, Plugin
from checker.model.locomotion.classic import classic_drive, classic_drives
from checker.model.locomotion.controlled import STEERING_CLASSES, controlled_drives
from checker.model.locomotion.drive import WING_CLASSES
from checker.model.locomotion.joint_control import CommandedWheels, commanded_wheels
from checker.model.locomotion.legs import is_legged
from checker.model.locomotion.locomotion import (
    DriveKind,
    Locomotion,
    Side,
    Track,
    TrackedDrive,
    Wheel,
    WheelDrive,
)
from checker.model.locomotion.motion_limits import limits_below, read_limits
from checker.model.locomotion.rotors import read_copter, read_rotor
from checker.model.locomotion.undriven import undriven_wheels
from checker.model.locomotion.wheels import WheelReader
from checker.source.text import Located
from checker.source.xml import Element

if TYPE_CHECKING:
    from checker.model.robot import Robot


# Reads the tracks of a robot: TrackController moves a belt, TrackedVehicle commands several.


_TRACK_SIDES = {"left_track": Side.LEFT, "right_track": Side.RIGHT}

# Defaults of gz-sim's TrackedVehicle.
_SEPARATION = 1.0
_STEERING_EFFICIENCY = 0.5


class TrackReader:
    """Finds the tracks of a robot by the links that plugins name."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.vehicles = [p for p in robot.plugins if p.class_name == "TrackedVehicle"]
        self.controllers = [p for p in robot.plugins if p.class_name == "TrackController"]

    @cached_property
    def tracks(self) -> dict[str, Track]:
        """All tracks by the scoped name of their link; of two controllers, the first counts."""
        tracks: dict[str, Track] = {}
        for controller in self.controllers:
            named = next((link.value for link in controller.at("link")), "")
            name = controller.scoped(named)
            link = self.robot.links_by_name.get(name)
            if link is not None and name not in tracks:
                limits = read_limits(controller.element)
                tracks[name] = Track(controller, link, self._sides.get(name), limits)
        return tracks

    def drives(self) -> Iterator[TrackedDrive]:
        """Yield the plugins that command tracks."""
        for plugin in self.vehicles:
            names = dict.fromkeys(name for name, _ in _commanded(plugin))
            yield TrackedDrive(
                plugin,
                tuple(self.tracks[name] for name in names if name in self.tracks),
                _number_or(plugin, "tracks_separation", _SEPARATION),
                _number_or(plugin, "steering_efficiency", _STEERING_EFFICIENCY),
                limits_below(plugin.element, "linear_velocity"),
                limits_below(plugin.element, "angular_velocity"),
            )

    @cached_property
    def _sides(self) -> dict[str, Side]:
        """Sides of the links that vehicles command; where they differ, the first counts."""
        sides: dict[str, Side] = {}
        for plugin in self.vehicles:
            for name, side in _commanded(plugin):
                sides.setdefault(name, side)
        return sides


def _commanded(plugin: Plugin) -> Iterator[tuple[str, Side]]:
    """Yield the scoped names of the links that a vehicle names, in its order."""
    for holder in plugin.element.children:
        side = _TRACK_SIDES.get(holder.tag)
        if side is not None:
            for child in holder.all("link"):
                yield plugin.scoped(child.text.value), side


_ACKERMANN, _MECANUM = "AckermannSteering", "MecanumDrive"
_WHEEL_CLASSES = ("DiffDrive", _ACKERMANN, _MECANUM)
_SIDES = {
    "left_joint": Side.LEFT,
    "front_left_joint": Side.LEFT,
    "back_left_joint": Side.LEFT,
    "right_joint": Side.RIGHT,
    "front_right_joint": Side.RIGHT,
    "back_right_joint": Side.RIGHT,
}
_STEERING_SIDES = {"left_steering_joint": Side.LEFT, "right_steering_joint": Side.RIGHT}

# Defaults of the gz-sim systems DiffDrive and AckermannSteering.
_WHEEL_SEPARATION = 1.0
_WHEEL_RADIUS = 0.2
_WHEEL_BASE = 1.0
_KINGPIN_WIDTH = 0.8
_STEERING_LIMIT = 0.5


def read_locomotion(robot: Robot) -> Locomotion:
    """Return what moves a robot."""
    drives = tuple(_wheel_drives(robot))
    belts = TrackReader(robot)
    tracked, tracks = tuple(belts.drives()), tuple(belts.tracks.values())
    rotors = tuple(read_rotor(robot, p) for p in _of_class(robot, "MulticopterMotorModel"))
    copters = tuple(read_copter(p) for p in _of_class(robot, "MulticopterVelocityControl"))
    legs = tuple(_leg_joints(robot)) if is_legged(robot) else ()
    wings = any(_of_class(robot, *WING_CLASSES))
    known = drives or tracked or tracks or rotors or copters or wings
    alone = CommandedWheels() if known else commanded_wheels(robot)
    kind = DriveKind.NONE
    if copters or any(rotor.lifts for rotor in rotors):
        kind = DriveKind.MULTICOPTER
    elif tracks or tracked:
        kind = DriveKind.TRACKED
    elif drives:
        kind = _wheeled_kind(drives)
    elif alone.drive is not None:
        kind = _wheeled_kind((alone.drive,))
    elif legs:
        kind = DriveKind.LEGGED
    unnamed = not drives and (alone.drive is not None or kind is DriveKind.NONE)
    free = tuple(undriven_wheels(robot)) if unnamed else ()
    return Locomotion(
        kind, drives, tracked, tracks, rotors, copters, legs, free, alone.drive, alone.doubt
    )


def _wheeled_kind(drives: tuple[WheelDrive, ...]) -> DriveKind:
    classes = {drive.plugin.class_name for drive in drives}
    steered = any(d.steering and d.plugin.class_name not in _WHEEL_CLASSES for d in drives)
    if steered or classes & STEERING_CLASSES or _ACKERMANN in classes:
        return DriveKind.ACKERMANN
    if classes & {_MECANUM, "MecanumDriveController"}:
        return DriveKind.MECANUM
    if "OmniWheelDriveController" in classes:
        return DriveKind.OMNI
    several = len(drives) > 1 or any(len(drives[0].wheels_on(side)) > 1 for side in Side)
    return DriveKind.SKID_STEER if several else DriveKind.DIFFERENTIAL


def _of_class(robot: Robot, *names: str) -> Iterator[Plugin]:
    return (plugin for plugin in robot.plugins if plugin.class_name in names)


def _leg_joints(robot: Robot) -> Iterator[Joint]:
    return (joint for joint in robot.joints if joint.scoped_name in robot.driven_joints)


def _wheel_drives(robot: Robot) -> Iterator[WheelDrive]:
    reader = WheelReader(robot)
    yield from classic_drives(robot, reader)
    yield from controlled_drives(robot, reader)
    for plugin in _of_class(robot, *_WHEEL_CLASSES):
        if classic_drive(plugin) is not None:
            continue
        steering = dict(_steering(robot, plugin))
        drive = WheelDrive(
            plugin,
            tuple(_wheels(reader, plugin, steering)),
            _number_or(plugin, "wheel_separation", _WHEEL_SEPARATION),
            _number_or(plugin, "wheel_radius", _WHEEL_RADIUS),
            read_limits(plugin.element, "linear_"),
            read_limits(plugin.element, "angular_"),
            steering=tuple(steering.items()),
        )
        yield replace(drive, **_ackermann(plugin), **_mecanum(plugin, drive))


def _wheels(reader: WheelReader, plugin: Plugin, steering: dict[Joint, Side]) -> Iterator[Wheel]:
    """Yield the wheels that a plugin names; one named twice for one side is one wheel."""
    knuckles = reader.knuckles(steering)
    seen: set[tuple[str, Side]] = set()
    for child, side in _sided(plugin.element, _SIDES):
        name = child.text
        wheel = None if (name.value, side) in seen else reader.read(plugin, name, side, knuckles)
        seen.add((name.value, side))
        if wheel is not None:
            yield wheel


def _ackermann(plugin: Plugin) -> dict[str, Located[float]]:
    if plugin.class_name != _ACKERMANN:
        return {}
    return {
        "wheel_base": _number_or(plugin, "wheel_base", _WHEEL_BASE),
        "kingpin_width": _number_or(plugin, "kingpin_width", _KINGPIN_WIDTH),
        "steering_limit": _number_or(plugin, "steering_limit", _STEERING_LIMIT),
    }


def _mecanum(plugin: Plugin, drive: WheelDrive) -> dict[str, Located[float]]:
    if plugin.class_name != _MECANUM:
        return {}
    base, separation = _number_or(plugin, "wheelbase", _WHEEL_BASE), drive.wheel_separation
    return {"turning_arm": Located((separation.value + base.value) / 2, separation.span)}


def _steering(robot: Robot, plugin: Plugin) -> Iterator[tuple[Joint, Side]]:
    for child, side in _sided(plugin.element, _STEERING_SIDES):
        joint = robot.joints_by_name.get(plugin.scoped(child.text.value))
        if joint is not None:
            yield joint, side


def _sided(element: Element, sides: dict[str, Side]) -> Iterator[tuple[Element, Side]]:
    for child in element.children:
        if child.tag in sides:
            yield child, sides[child.tag]


def _number_or(plugin: Plugin, path: str, default: float) -> Located[float]:
    return plugin.number(path) or Located(default, plugin.span, stated=False)
