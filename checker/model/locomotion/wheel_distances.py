"""The distances that drive plugins count on, each with the one that the robot has."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.components import Plugin
from checker.model.geometry.transform import Vector
from checker.model.locomotion.locomotion import Side, TrackedDrive, WheelDrive
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.model.robot import Robot

_SHORTEST, _LONGEST = 1e-6, 1e6
"""Metres; others are no distances of a robot's parts."""
_FORWARD: Vector = (1.0, 0.0, 0.0)
_LEFT: Vector = (0.0, 1.0, 0.0)


class CountedDistance(Record, eq=False):
    """A distance that a plugin counts on.

    Attributes:
        tag: The parameter.
        stated: Metres; the plugin's default (`stated` false) where it says none.
        true: Of the parts in the robot, metres.
        what: The parts, in words.
        steers: Whether steering angles come from it.
    """

    plugin: Plugin
    tag: str
    stated: Located[float]
    true: float
    what: str
    steers: bool = False


def counted_distances(robot: Robot) -> Iterator[CountedDistance]:
    """Yield the distances of all drive plugins; those of parts without a place are left out."""
    for drive in robot.locomotion.wheel_drives:
        yield from _of_wheels(drive)
        yield from _of_steering(robot, drive)
    for tracked in robot.locomotion.tracked_drives:
        yield from _of_tracks(robot, tracked)


def _of_wheels(drive: WheelDrive) -> Iterator[CountedDistance]:
    axis = next((wheel.axis for wheel in drive.wheels if wheel.axis is not None), None)
    left, right = ([wheel.centre for wheel in drive.on(side)] for side in Side)
    true = _apart(left, right, axis) if axis is not None else None
    if true is not None:
        separation = drive.wheel_separation
        yield CountedDistance(
            drive.plugin, "wheel_separation", separation, true, "left and right wheels"
        )


def _of_steering(robot: Robot, drive: WheelDrive) -> Iterator[CountedDistance]:
    places = [
        (side, pose.translation)
        for joint, side in drive.steering
        if (pose := robot.pose_of_joint(joint)) is not None
    ]
    left, right = ([place for on, place in places if on is side] for side in Side)
    width = _apart(left, right, _LEFT)
    if width is not None and drive.kingpin_width is not None:
        what = "steering joints"
        yield CountedDistance(
            drive.plugin, "kingpin_width", drive.kingpin_width, width, what, steers=True
        )
    rear = [wheel.centre for wheel in drive.wheels if wheel.steering is None]
    base = _apart([*left, *right], rear, _FORWARD)
    if base is not None and drive.wheel_base is not None:
        yield CountedDistance(drive.plugin, "wheel_base", drive.wheel_base, base, "axles", True)


def _of_tracks(robot: Robot, drive: TrackedDrive) -> Iterator[CountedDistance]:
    left, right = (
        [
            box.centre
            for track in drive.tracks
            if track.side is side
            and (box := robot.box_of(track.link, visuals_too=False)) is not None
        ]
        for side in Side
    )
    # Flippers stand outside of the tracks that carry the robot.
    inner_left, inner_right = (
        sorted(side, key=lambda centre: abs(centre[1]))[:1] for side in (left, right)
    )
    true = _apart(inner_left, inner_right, _LEFT)
    if true is not None:
        what = "left and right tracks"
        yield CountedDistance(drive.plugin, "tracks_separation", drive.separation, true, what)


def _apart(
    some: Iterable[Vector | None], others: Iterable[Vector | None], axis: Vector
) -> float | None:
    """Return how far the middles of two groups of points are apart along an axis, metres."""
    one, other = _middle(some, axis), _middle(others, axis)
    if one is None or other is None:
        return None
    distance = abs(one - other)
    return distance if _SHORTEST < distance < _LONGEST else None


def _middle(points: Iterable[Vector | None], axis: Vector) -> float | None:
    along = [sum(a * b for a, b in zip(p, axis, strict=True)) for p in points if p is not None]
    return sum(along) / len(along) if along else None
