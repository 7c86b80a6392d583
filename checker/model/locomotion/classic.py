"""Drive plugins of Gazebo Classic, which URDF files name in `<gazebo>` tags."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import zip_longest
from typing import TYPE_CHECKING

from msgspec import convert

from checker.base.record import Record
from checker.base.resources import table
from checker.model.components import Plugin
from checker.model.locomotion.locomotion import MotionLimits, Side, Wheel, WheelDrive
from checker.model.locomotion.wheels import WheelReader
from checker.model.plugin_library import library_stem
from checker.model.values import parse_number
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.model.robot import Robot

_Named = tuple[Located[str], Side]


class ClassicDrive(Record):
    """Names of the parameters of a drive plugin; see `drives` in `gazebo_classic_plugins.json`."""

    match: str
    left: tuple[str, ...]
    right: tuple[str, ...]
    separation: str
    diameter: str
    default_separation: float
    default_diameter: float
    torque: str
    default_torque: float
    acceleration: str
    each_pair: bool
    swapped_unless_false: str

    def swaps(self, plugin: Plugin) -> bool:
        """Return whether the plugin treats the wheels that it names as left as the right ones."""
        tag = self.swapped_unless_false
        words = [text.value.strip().lower() for text in plugin.at(tag)] if tag else ["false"]
        return not words or words[0] not in ("false", "0")

    def joints(self, plugin: Plugin) -> list[tuple[_Named, ...]]:
        """Return the joints that a plugin names and their sides, for each set of distances."""
        left, right = Side.LEFT, Side.RIGHT
        if self.swaps(plugin):
            left, right = right, left
        on_left = [(name, left) for tag in self.left for name in plugin.at(tag)]
        on_right = [(name, right) for tag in self.right for name in plugin.at(tag)]
        if not self.each_pair:
            return [(*on_left, *on_right)]
        pairs = zip_longest(on_left, on_right)
        return [tuple(name for name in pair if name is not None) for pair in pairs]


def classic_drive(plugin: Plugin) -> ClassicDrive | None:
    """Return how a drive plugin of Gazebo Classic calls its parameters; None for all others.

    The ports to ROS 1 and to ROS 2 are one library by name: the joints' tags differ.
    """
    stem = library_stem(plugin.filename.value)
    ports = [drive for drive in _drives() if re.fullmatch(drive.match, stem)]
    return next((drive for drive in ports if any(drive.joints(plugin))), next(iter(ports), None))


@cache
def _drives() -> tuple[ClassicDrive, ...]:
    return convert(table("gazebo_classic_plugins")["drives"], tuple[ClassicDrive, ...])


def enforces_limits(robot: Robot) -> bool:
    """Return whether the simulator keeps driven joints within limits of velocity and effort.

    Drive plugins of Gazebo Classic set speeds with a torque of their own.
    """
    return not any(classic_drive(plugin) for plugin in robot.all_plugins)


def classic_joints(plugins: Iterable[Plugin]) -> Iterator[str]:
    """Yield the names of the wheel joints that drive plugins of Gazebo Classic turn."""
    for plugin in plugins:
        drive = classic_drive(plugin)
        for pair in drive.joints(plugin) if drive is not None else ():
            yield from (name.value for name, _ in pair)


def wheel_torques(robot: Robot) -> dict[str, tuple[str, Located[float]]]:
    """Return the parameter and value of the greatest torque, N·m, by the joint that it turns.

    Drive plugins of Gazebo Classic turn their joints with it, whatever effort the joints state.
    """
    torques: dict[str, tuple[str, Located[float]]] = {}
    for plugin in robot.plugins:
        if (drive := classic_drive(plugin)) is not None:
            stated = list(_numbers(plugin, drive.torque))
            torque = _value_at(stated, 0, drive.default_torque, plugin)
            for name, _ in (named for pair in drive.joints(plugin) for named in pair):
                torques.setdefault(plugin.scoped(name.value), (drive.torque, torque))
    return torques


def classic_drives(robot: Robot, reader: WheelReader) -> Iterator[WheelDrive]:
    """Yield what drive plugins of Gazebo Classic turn: one drive for each set of distances."""
    for plugin in robot.plugins:
        drive = classic_drive(plugin)
        if drive is None:
            continue
        separations = list(_numbers(plugin, drive.separation))
        diameters = list(_numbers(plugin, drive.diameter))
        at_rim = _acceleration_at_rim(plugin, drive)
        for number, named in enumerate(drive.joints(plugin)):
            diameter = _value_at(diameters, number, drive.default_diameter, plugin)
            separation = _value_at(separations, number, drive.default_separation, plugin)
            yield WheelDrive(
                plugin,
                tuple(_wheels(reader, plugin, named)),
                separation,
                Located(diameter.value / 2, diameter.span, stated=diameter.stated),
                _within(plugin, at_rim),
                _within(plugin, at_rim, separation.value / 2),
                separation_tag=drive.separation,
                diameter_tag=drive.diameter,
                swaps=drive.swaps(plugin),
            )


def _acceleration_at_rim(plugin: Plugin, drive: ClassicDrive) -> Located[float] | None:
    """Return how fast the plugin speeds its wheels up at the rim, m/s²; None if at once."""
    stated = next(_numbers(plugin, drive.acceleration), None) if drive.acceleration else None
    return stated if stated is not None and stated.value > 0.0 else None


def _within(plugin: Plugin, at_rim: Located[float] | None, arm: float = 1.0) -> MotionLimits:
    """Return the limits of a motion in which wheels roll `arm` metres for 1 m or 1 rad."""
    if at_rim is None or not arm > 0.0:
        return MotionLimits(plugin.span)
    most = at_rim.value / arm
    return MotionLimits(
        plugin.span,
        min_acceleration=Located(-most, at_rim.span),
        max_acceleration=Located(most, at_rim.span),
    )


def _wheels(reader: WheelReader, plugin: Plugin, named: Iterable[_Named]) -> Iterator[Wheel]:
    for name, side in named:
        wheel = reader.read(plugin, name, side, {})
        if wheel is not None:
            yield wheel


def _numbers(plugin: Plugin, tag: str) -> Iterator[Located[float]]:
    for text in plugin.at(tag):
        value = parse_number(text.value)
        if value is not None:
            yield Located(value, text.span)


def _value_at(
    stated: list[Located[float]], number: int, default: float, plugin: Plugin
) -> Located[float]:
    if number < len(stated):
        return stated[number]
    return Located(default, plugin.span, stated=False)
