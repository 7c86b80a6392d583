"""Reads the tracks of a robot: TrackController moves a belt, TrackedVehicle commands several."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

from checker.model.components import Plugin
from checker.model.locomotion.locomotion import Side, Track, TrackedDrive
from checker.model.locomotion.plugin_limits import limits_below, read_limits
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.model.robot import Robot

_SIDES = {"left_track": Side.LEFT, "right_track": Side.RIGHT}

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
        found: dict[str, Track] = {}
        for controller in self.controllers:
            named = next((link.value for link in controller.at("link")), "")
            name = _scoped(controller, named)
            link = self.robot.links_by_name.get(name)
            if link is not None and name not in found:
                limits = read_limits(controller.element)
                found[name] = Track(controller, link, self._sides.get(name), limits)
        return found

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
        side = _SIDES.get(holder.tag)
        if side is not None:
            for child in holder.all("link"):
                yield _scoped(plugin, child.text.value), side


def _scoped(plugin: Plugin, name: str) -> str:
    return f"{plugin.nested_in}::{name}" if plugin.nested_in else name


def _number_or(plugin: Plugin, path: str, default: float) -> Located[float]:
    return plugin.number(path) or Located(default, plugin.span, stated=False)
