"""Fixes that write other numbers into a robot, or move a part of it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from checker.finding import Edit, Fix, Safety
from checker.model.components import Collision, Visual
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot
from checker.model.values import parse_number
from checker.source.text import Located, Span
from checker.source.xml_insertion import attribute_edits, insert_into

_SAME = 1e-9
"""Relative difference of numbers that are the same."""
_NOISE = 1e-12
"""Metres and radians that rounding leaves behind."""


def number_text(value: float) -> str:
    """Return a number with six digits, and a quarter of a turn with all of them."""
    quarters = round(value / (math.pi / 2))
    if quarters and math.isclose(value, quarters * (math.pi / 2), rel_tol=_SAME):
        return repr(quarters * (math.pi / 2))
    return f"{value:.6g}"


def rewrite(numbers: Iterable[tuple[Located[float], float]], times: float = 1.0) -> Fix | None:
    """Return the fix that writes other numbers over those of a file; None if there is none.

    Numbers that a file does not spell out, such as `${radius / 2}`, are not its own to change.

    Args:
        numbers: What is read, each with what it should be.
        times: What the file states of each, such as 2 for the diameter of a radius.
    """
    edits: dict[Edit, None] = {}
    for number, value in numbers:
        if math.isclose(number.value, value, rel_tol=_SAME):
            continue
        if not number.stated or not math.isfinite(value) or not is_literal(number.span):
            return None
        edits[number.span.replacement(number_text(value * times))] = None
    return Fix(Safety.UNSAFE, tuple(edits)) if edits else None


def is_shared(one: Span, other: Span) -> bool:
    """Return whether two values were read from one text: a macro, called twice."""
    first, second = one.place(), other.place()
    return (first.file, first.line, first.column) == (second.file, second.line, second.column)


def is_literal(span: Span) -> bool:
    """Return whether a number stands in the file as it was read: xacro may have computed it."""
    place = span.place()
    written = place.snippet[place.column - 1 : place.end_column - 1]
    return parse_number(span.text) is not None and written == span.text


def along_z(axis: Vector) -> Transform:
    """Return a turn by roll and pitch that lays z along a line of length 1."""
    x, y, z = axis if axis[1] <= 0.0 else (-axis[0], -axis[1], -axis[2])
    beside = math.hypot(x, z)
    pitch = math.atan2(x, z) if beside > _NOISE else 0.0
    return Transform.from_xyz_rpy((0.0, 0.0, 0.0), (math.atan2(-y, beside), pitch, 0.0))


def reposed(robot: Robot, part: Collision | Visual, new: Transform) -> Fix | None:
    """Return the fix that gives a shape another pose; None if its pose is not stated as numbers.

    Args:
        robot: The robot of the shape.
        part: The shape.
        new: The new pose, in the same frame.
    """
    edits = pose_edits(robot, part, new)
    return Fix(Safety.UNSAFE, edits) if edits else None


def pose_edits(robot: Robot, part: Collision | Visual, new: Transform) -> tuple[Edit, ...]:
    """Return the edits of `reposed`; none where there is no such fix."""
    urdf = robot.conventions.is_urdf
    written = part.element.written
    element = written.child("origin" if urdf else "pose")
    xyz, rpy = map(_texts, (new.translation, new.rpy))
    if element is None:
        line = f'<origin xyz="{xyz}" rpy="{rpy}"/>' if urdf else f"<pose>{xyz} {rpy}</pose>"
        return (insert_into(written, [line]),)
    stated = [number for number in part.pose.numbers if number.stated]
    if not part.pose.in_radians or not all(is_literal(number.span) for number in stated):
        return ()
    if not urdf:
        return (element.text_span.replacement(f"{xyz} {rpy}"),)
    moved = math.dist(new.translation, part.pose.transform.translation) > _NOISE
    values = {"xyz": xyz, "rpy": rpy} if moved else {"rpy": rpy}
    return attribute_edits(element, values)


def _texts(numbers: Sequence[float]) -> str:
    return " ".join(number_text(number if abs(number) > _NOISE else 0.0) for number in numbers)
