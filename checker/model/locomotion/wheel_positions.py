"""Positions of wheels: their distances as drive plugins use them, and their heights."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.base.record import Record
from checker.model.components import Plugin
from checker.model.controllers import Controller
from checker.model.geometry.transform import Vector, dot
from checker.model.locomotion.locomotion import Side, TrackedDrive, Wheel, WheelDrive
from checker.model.locomotion.rolling_parts import RollingPart, rolling_parts
from checker.model.locomotion.wheels import is_misaligned, tread
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.model.robot import Robot


# Whether wheels and tracks stand on one plane, by their lowest points.


_MIDDLE = 0.1
"""Share of the robot's width within which a wheel is in its middle: a caster."""
FARTHEST = 1e6
"""Metres; numbers beyond are no places."""


class Foot(Record, eq=False):
    """The lowest point of a wheel or track.

    Attributes:
        along: Its position in the robot's driving direction, metres.
        side: 1 and −1 for the two sides, 0 for the middle.
        height: Its z in the robot's frame, metres.
        off: Metres above (below, if negative) the level of the other wheels.
    """

    part: RollingPart
    along: float
    side: int
    height: float
    off: float = 0.0


def uneven_wheels(robot: Robot, tolerance: float) -> list[Foot]:
    """Return wheels and tracks that are more than `tolerance` metres off the level of the others.

    Wheels that a wheel on the other side matches are meant so: larger rear wheels, front wheels
    that are raised to climb. Wheels on a suspension or on another segment of the robot find the
    ground by themselves, and wheels that stand askew reach nowhere in particular.
    """
    feet = [
        foot
        for foot in _feet(robot, rolling_parts(robot))
        if not foot.part.suspended and not _askew(robot, foot.part)
    ]
    if len(feet) < 2:
        return []
    matches = _Matches(feet, tolerance)
    off = [
        replace(foot, off=foot.height - level)
        for foot, level in zip(feet, _level_of_others(feet), strict=True)
        if abs(foot.height - level) > tolerance and not matches.has(foot)
    ]
    # Where each wheel is off the level of the others, those in the air are said.
    return off if len(off) < len(feet) else [foot for foot in off if foot.off > 0]


def _feet(robot: Robot, wheels: Sequence[RollingPart]) -> Iterator[Foot]:
    across = _axle(robot)
    forward = (across[1], -across[0], 0.0)
    sideways = [dot(part.box.centre, across) for part in wheels]
    left, right = max(sideways, default=0.0), min(sideways, default=0.0)
    for part, at in zip(wheels, sideways, strict=True):
        along, beside = dot(part.box.centre, forward), at - (left + right) / 2
        in_middle = abs(beside) <= _MIDDLE * (left - right)
        side = 0 if in_middle else 1 if beside > 0 else -1
        if abs(along) < FARTHEST:
            yield Foot(part, along, side, part.box.low[2])


class _Matches:
    """Finds for a wheel the one across the robot that is as far in front, and as high."""

    def __init__(self, feet: Sequence[Foot], tolerance: float) -> None:
        self.tolerance = tolerance
        sizes = [foot.part.box.high[2] - foot.part.box.low[2] for foot in feet]
        self.near = max(min(sizes) / 2, tolerance)
        self.heights: dict[tuple[int, int], list[float]] = {}
        for foot in sorted(feet, key=lambda foot: foot.height):
            self.heights.setdefault((foot.side, self._row(foot)), []).append(foot.height)

    def has(self, foot: Foot) -> bool:
        """Return whether there is one; a wheel in the middle matches itself."""
        rows = (self._row(foot) + step for step in (-1, 0, 1))
        return any(self._as_high(foot, self.heights.get((-foot.side, row), [])) for row in rows)

    def _as_high(self, foot: Foot, heights: Sequence[float]) -> bool:
        next_one = bisect_left(heights, foot.height - self.tolerance)
        return next_one < len(heights) and heights[next_one] <= foot.height + self.tolerance

    def _row(self, foot: Foot) -> int:
        return round(foot.along / self.near)


def _level_of_others(feet: Sequence[Foot]) -> list[float]:
    """Return, for each wheel, the median height of all others."""
    heights = sorted(foot.height for foot in feet)
    count = len(heights) - 1

    def without(own: int, rank: int) -> float:
        return heights[rank + (rank >= own)]

    ranks = [bisect_left(heights, foot.height) for foot in feet]
    return [(without(own, (count - 1) // 2) + without(own, count // 2)) / 2 for own in ranks]


def _axle(robot: Robot) -> Vector:
    """Return the direction of the wheels' axes; y where that is not known."""
    for wheel in (*robot.locomotion.wheels, *robot.locomotion.undriven):
        if wheel.axis is not None and wheel.steering is None and abs(wheel.axis[2]) < 0.5:
            return (wheel.axis[0], wheel.axis[1], 0.0)
    return (0.0, 1.0, 0.0)


def _askew(robot: Robot, part: RollingPart) -> bool:
    return part.wheel is not None and is_misaligned(robot, part.wheel)


_SHORTEST, _LONGEST = 1e-6, 1e6
"""Metres; others are no distances of a robot's parts."""
_FORWARD: Vector = (1.0, 0.0, 0.0)
_LEFT: Vector = (0.0, 1.0, 0.0)


class CountedDistance(Record, eq=False):
    """A distance that a plugin counts on.

    Attributes:
        tag: The parameter.
        stated: Metres; the plugin's default (`stated` false) where it states none.
        true: The measure of the parts in the robot, metres.
        what: The parts, in words.
        steers: Whether steering angles come from it.
        slips: Whether wheels may slip sideways in a turn, so that it is raised on purpose.
    """

    plugin: Plugin | Controller
    tag: str
    stated: Located[float]
    true: float
    what: str
    steers: bool = False
    slips: bool = True


def counted_distances(robot: Robot) -> Iterator[CountedDistance]:
    """Yield the distances of all drive plugins; those of parts without a place are left out."""
    for drive in robot.locomotion.wheel_drives:
        yield from _of_wheels(robot, drive)
        yield from _of_steering(robot, drive)
    for tracked in robot.locomotion.tracked_drives:
        yield from _of_tracks(robot, tracked)


def _of_wheels(robot: Robot, drive: WheelDrive) -> Iterator[CountedDistance]:
    axis = drive.axis
    left, right = ([middle_of(robot, wheel) for wheel in drive.wheels_on(side)] for side in Side)
    true = _distance(left, right, axis) if axis is not None else None
    if true is not None and drive.separation_tag:
        what, slips = "left and right wheels", drive.slips
        separation = drive.wheel_separation
        yield CountedDistance(
            drive.plugin, drive.separation_tag, separation, true, what, slips=slips
        )


def middle_of(robot: Robot, wheel: Wheel) -> Vector | None:
    """Return the middle of what a wheel rolls on; the joint's origin where that is not known."""
    rolls = tread(robot, wheel)
    return wheel.centre if rolls is None or wheel.centre is None else rolls.box.centre


def _of_steering(robot: Robot, drive: WheelDrive) -> Iterator[CountedDistance]:
    places = [
        (side, pose.translation)
        for joint, side in drive.steering
        if (pose := robot.pose_of_joint(joint)) is not None
    ]
    left, right = ([place for on, place in places if on is side] for side in Side)
    width = _distance(left, right, _LEFT)
    if width is not None and drive.kingpin_width is not None and drive.kingpin_tag:
        what = "steering joints"
        yield CountedDistance(
            drive.plugin, drive.kingpin_tag, drive.kingpin_width, width, what, steers=True
        )
    rear = [middle_of(robot, wheel) for wheel in drive.wheels if wheel.steering is None]
    base = _distance([*left, *right], rear, _FORWARD)
    if base is not None and drive.wheel_base is not None:
        stated = drive.wheel_base
        yield CountedDistance(drive.plugin, drive.base_tag, stated, base, "axles", steers=True)


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
    true = _distance(inner_left, inner_right, _LEFT)
    if true is not None:
        what = "left and right tracks"
        yield CountedDistance(drive.plugin, "tracks_separation", drive.separation, true, what)


def _distance(
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
