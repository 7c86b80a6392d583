"""The parts that a robot rolls on: wheels and tracks, and how they are connected to its body."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.components import Link
from checker.model.geometry.boxes import Box
from checker.model.geometry.placed_shapes import place_shapes, union
from checker.model.locomotion.locomotion import Wheel
from checker.model.tree import WORLD

if TYPE_CHECKING:
    from checker.model.robot import Robot

_TURNING = ("continuous", "revolute")


class RollingPart(Record, eq=False):
    """A wheel or a track.

    Attributes:
        links: All of it; the first is the wheel's or the track's own.
        wheel: None for a track, and for a wheel that no plugin drives.
        is_track: Whether it is a track.
        box: The bounding box of its collisions, in the robot's frame.
        suspended: Whether it is connected to a joint that gives way, beside its own and its
            steering.
    """

    links: tuple[Link, ...]
    wheel: Wheel | None
    is_track: bool
    box: Box
    suspended: bool

    @property
    def link(self) -> Link:
        """The wheel or the track."""
        return self.links[0]


def rolling_parts(robot: Robot) -> list[RollingPart]:
    """Return all wheels and tracks whose collisions are known.

    Wheels are those that a plugin drives, and links that are called so and turn on a joint.
    """
    steered = {joint for drive in robot.locomotion.wheel_drives for joint, _ in drive.steering}
    passive = {
        tie.joint.scoped_name
        for tie in robot.tree.ties
        if tie.joint.type.value != "fixed" and tie.joint not in steered
    }
    giving = _links_that_give(robot, passive)
    tracks = {track.link.scoped_name for track in robot.locomotion.tracks}
    parts = []
    for links, wheel in _parts(robot):
        shapes = [
            piece.box for link in links for piece in place_shapes(robot, link, link.collisions)
        ]
        box = union(shapes)
        above = robot.tree.ties_above.get(links[0].scoped_name, ())
        suspended = any(giving.get(tie.parent, False) for tie in above)
        if box is not None:
            is_track = links[0].scoped_name in tracks
            parts.append(RollingPart(links, wheel, is_track, box, suspended))
    return parts


def _parts(robot: Robot) -> Iterator[tuple[tuple[Link, ...], Wheel | None]]:
    seen: set[str] = set()
    for wheel in robot.locomotion.wheels:
        seen.update(link.scoped_name for link in wheel.body)
        yield wheel.body, wheel
    others = [track.link for track in robot.locomotion.tracks]
    others += [link for link in robot.wheels if _turns(robot, link)]
    undriven = {wheel.link.scoped_name: wheel for wheel in robot.locomotion.undriven}
    for link in others:
        if link.scoped_name not in seen:
            seen.add(link.scoped_name)
            yield (link,), undriven.get(link.scoped_name)


def _turns(robot: Robot, link: Link) -> bool:
    ties = robot.tree.ties_above.get(link.scoped_name, ())
    return any(tie.joint.type.value in _TURNING for tie in ties)


def _links_that_give(robot: Robot, passive: set[str]) -> dict[str, bool]:
    """State for each link whether a joint between it and the root lets it move."""
    gives: dict[str, bool] = {WORLD: False}
    for start in robot.tree.links:
        path: dict[str, bool] = {}
        at = start
        while at not in gives and at not in path:
            above = robot.tree.ties_above.get(at)
            if not above:
                gives[at] = False
                break
            path[at] = above[0].joint.scoped_name in passive
            at = above[0].parent
        moves = gives.get(at, False)
        for name in reversed(path):
            gives[name] = moves = moves or path[name]
    return gives


def carriers(robot: Robot, parts: Iterable[RollingPart]) -> set[str]:
    """Return the links that parts are connected to, directly or over others, by scoped name."""
    found: set[str] = set()
    for part in parts:
        waiting = [part.link.scoped_name]
        while waiting:
            above = robot.tree.ties_above.get(waiting.pop(), ())
            fresh = [tie.parent for tie in above if tie.parent not in found]
            found.update(fresh)
            waiting.extend(fresh)
    return found - {WORLD}


def on_one_axle(parts: Iterable[RollingPart]) -> bool:
    """Return whether all wheels are in one line: the robot then stands on something else too."""
    wheels = list(parts)
    if any(part.is_track for part in wheels):
        return False
    return any(
        _spread([part.box.centre[axis] for part in wheels])
        < min((part.box.high[axis] - part.box.low[axis]) / 2 for part in wheels)
        for axis in (0, 1)
    )


def _spread(numbers: list[float]) -> float:
    return max(numbers) - min(numbers)
