"""The relays that a robot drops: Breadcrumbs plugins."""

from __future__ import annotations

from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.components import Plugin
from checker.model.geometry.transform import Vector
from checker.model.values import parse_number
from checker.source.text import Located, Span

if TYPE_CHECKING:
    from checker.model.robot import Robot

BREADCRUMBS_CLASS = "Breadcrumbs"


class Breadcrumbs(Record, eq=False):
    """A Breadcrumbs plugin.

    Attributes:
        max_deployments: The number that it drops; None if not stated (then there is no limit).
        topic: What makes it drop one; None if not stated.
        disable_physics_time: Seconds until a dropped one is held in place; None if not stated.
        drop: Its position when dropped, in the robot's frame, metres; None if that cannot be read.
    """

    plugin: Plugin
    max_deployments: Located[float] | None
    topic: Located[str] | None
    disable_physics_time: Located[float] | None
    drop: Located[Vector] | None

    @property
    def span(self) -> Span:
        """The plugin."""
        return self.plugin.span


def breadcrumbs(robot: Robot) -> tuple[Breadcrumbs, ...]:
    """Return what drops relays; a robot may have one plugin for each side."""
    return tuple(
        _breadcrumbs_of(plugin)
        for plugin in robot.plugins
        if plugin.class_name == BREADCRUMBS_CLASS
    )


def _breadcrumbs_of(plugin: Plugin) -> Breadcrumbs:
    return Breadcrumbs(
        plugin,
        plugin.number("max_deployments"),
        next(plugin.at("topic"), None),
        plugin.number("disable_physics_time"),
        _drop(plugin),
    )


def _drop(plugin: Plugin) -> Located[Vector] | None:
    """Return where the dropped model stands; one without `<pose>` is at the robot's origin."""
    model = plugin.element.child("breadcrumb", "sdf", "model")
    if model is None:
        return None
    pose = model.child("pose")
    if pose is None or not pose.text.stated:
        return Located((0.0, 0.0, 0.0), model.span, stated=False)
    x, y, z, *_ = (*(parse_number(word) for word in pose.text.value.split()[:3]), *(None,) * 3)
    if x is None or y is None or z is None:
        return None
    return Located((x, y, z), pose.text.span)
