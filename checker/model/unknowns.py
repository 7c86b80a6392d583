"""Unknown parts of a robot because of a fault that one rule reports, for the other rules."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import chain
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.base.words import Suggestions
from checker.model.components import Joint
from checker.model.faults import FaultKind
from checker.model.locomotion.classic import enforces_limits
from checker.model.tree import LinkTree

if TYPE_CHECKING:
    from checker.model.robot import Robot


# Parts without a place.


class LooseGroup(Record):
    """Links that are connected to each other, and that no joint connects to the robot.

    Attributes:
        top: The link that the others are connected to.
        links: All of them, by scoped name.
        unclear: A joint with an unknown end, which may be meant to connect them.
    """

    top: str
    links: tuple[str, ...]
    unclear: Joint | None = None


class LooseParts(Record):
    """Parts that no joint connects to the robot.

    Attributes:
        main: The root link of the rest of the robot; empty without any.
        groups: The groups in the order of the file.
    """

    main: str = ""
    groups: tuple[LooseGroup, ...] = ()


def loose_parts(robot: Robot) -> LooseParts:
    """Find links, and groups of links, that no joint connects to the robot.

    Links at a joint with an unknown end are not among them, nor are loops.
    """
    tree = robot.tree
    tops = {top: group for group in tree.groups if (top := _top(tree, group))}
    if len(tops) < 2 or robot.is_static:
        return LooseParts()
    main = max(tops, key=lambda top: len(tops[top]))
    # A nested model that nothing ties is a robot of its own.
    apart = {top: group for top, group in tops.items() if top != main and "::" not in top}
    excused, unclear = _tied_by_broken_joints(tree, chain.from_iterable(apart.values()))
    excused |= {tie.child for tie in tree.ties if tie.parent == tie.child}
    loose = (
        LooseGroup(top, tuple(group), unclear)
        for top, group in apart.items()
        if excused.isdisjoint(group)
    )
    return LooseParts(main, tuple(loose))


def _tied_by_broken_joints(tree: LinkTree, apart: Iterable[str]) -> tuple[set[str], Joint | None]:
    """Return links at joints with an unknown end, among them those whose names are meant.

    The second value is a joint whose intended link is not known.
    """
    suggestions, anywhere = Suggestions(apart), Suggestions(tree.links)
    meant = {tie.known for tie in tree.broken if tie.known is not None}
    unclear = None
    for tie in tree.broken:
        name = tie.joint.scope + tie.missing.value
        near = suggestions.closest(name)
        if near is not None:
            meant.add(near)
        elif anywhere.closest(name) is None:
            unclear = tie.joint
    return meant, unclear


def _top(tree: LinkTree, group: list[str]) -> str | None:
    """Return the first link of a group that has no parent."""
    return next((name for name in group if name not in tree.ties_above), None)


def unplaced_part(robot: Robot) -> str:
    """Return why a part has no place on the robot, as the end of a sentence; empty if all have.

    These are the faults that KIN001, KIN002, KIN003 and KIN010 report.
    """
    return next(_unplaced(robot), "")


def _unplaced(robot: Robot) -> Iterator[str]:
    tree = robot.tree
    for broken in tree.broken:
        yield f"an end of joint {broken.joint.name.value!r} is not known"
    for tie in tree.ties:
        if tie.parent == tie.child:
            yield f"joint {tie.joint.name.value!r} connects a link to itself"
    for child, ties in tree.ties_above.items():
        if len(ties) > 1:
            yield f"link {child!r} has two parents"
    if any(tree.loops()):
        yield "the joints connect links in a loop"
    for group in robot.loose_parts.groups:
        yield f"no joint connects link {group.top!r} to the robot"
    for fault in robot.faults_of(FaultKind.FRAME):
        yield fault.message


# Wheels and tracks that touch nothing, or cannot turn.


def bare_wheel(robot: Robot) -> str:
    """Return which driven wheel or track touches nothing, as a sentence; empty if none does.

    It has no collision, or none whose size is known.
    """
    bodies = [wheel.body for wheel in robot.locomotion.wheels]
    bodies += [(track.link,) for track in robot.locomotion.tracks]
    for body in bodies:
        shapes = ((link, shape) for link in body for shape in link.collisions)
        if all(robot.box_of_shape(link, shape) is None for link, shape in shapes):
            return f"{body[0].name.value!r} has no collision of a known size"
    return ""


def stuck_wheel(robot: Robot) -> str:
    """Return which joint of a driven wheel cannot turn, as a sentence; empty if all can."""
    limited = enforces_limits(robot)
    for wheel in robot.locomotion.wheels:
        why = wheel.joint.immovable
        if limited and any(axis.velocity.value == 0.0 for axis in wheel.joint.axes):
            why = "its velocity limit is 0"
        if why:
            return f"joint {wheel.joint.name.value!r} cannot move: {why}"
    return ""


# Links whose mass is none.


def unknown_masses(robot: Robot) -> dict[str, str]:
    """Return the links whose stated mass is none, by scoped name, with the reason.

    The reason is the end of a sentence. A mass of zero is right for frames, but not for bodies;
    the readers of URDF take each link without mass for a frame, so there it is known.
    """
    misread = {fault.span for fault in robot.faults_of(FaultKind.VALUE)}
    unknown = {}
    is_body = not robot.conventions.has_massless_links
    for link in robot.links:
        mass = link.inertial.mass if link.inertial is not None else None
        if mass is None or not mass.stated:
            continue
        if mass.span in misread or not math.isfinite(mass.value):
            unknown[link.scoped_name] = f"the mass of link {link.name.value!r} is not known"
        elif mass.value < 0.0 or (mass.value == 0.0 and link.collisions and is_body):
            unknown[link.scoped_name] = f"the mass of link {link.name.value!r} is not positive"
    return unknown
