"""Poses and directions in other frames, written over the numbers that stand there."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from checker.flattening.draft import Draft
from checker.model.sdf.pose_numbers import in_degrees, transform_of
from checker.model.transform import Transform, Vector
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element

_SAME = 1e-14
"""Numbers that differ by less are the same but for rounding."""
_DIGITS = 15
"""Behind the point: metres and radians to far below what any solver tells apart."""


def write_pose(draft: Draft, holder: Element, pose: Transform) -> None:
    """Have the `<pose>` of an element say this one; what it says already stays as it is."""
    element = holder.child("pose")
    if element is None:
        if _differs(pose, Transform()):
            draft.insert(holder, f"<pose>{pose_text(pose)}</pose>")
        return
    read = None if in_degrees(element) else _numbers(element, 6)
    if read is None:
        draft.put(element.whole_span, f"<pose>{pose_text(pose)}</pose>")
        return
    turned = _differs(Transform(pose.rotation), Transform(stated_pose(element).rotation))
    angles = pose.rpy if turned else tuple(number.value for number in read[3:])
    _write(draft, read, (*pose.translation, *angles))


def stated_pose(element: Element) -> Transform:
    """Return what the numbers in a `<pose>` say; that of no change where there are not six."""
    read = _numbers(element, 6)
    if read is None:
        return Transform()
    return transform_of(element, (number.value for number in read))


def write_direction(draft: Draft, axis: Element, direction: Vector) -> None:
    """Have the `<xyz>` of an axis say this direction."""
    element = axis.child("xyz")
    read = _numbers(element, 3) if element is not None else None
    if read is not None:
        _write(draft, read, direction)
    elif element is not None:
        draft.put(element.whole_span, f"<xyz>{_text(direction)}</xyz>")
    else:
        draft.insert(axis, f"<xyz>{_text(direction)}</xyz>")


def pose_text(pose: Transform) -> str:
    """Return the six numbers of a pose."""
    return _text((*pose.translation, *pose.rpy))


def _numbers(element: Element, count: int) -> tuple[Located[float], ...] | None:
    """Return the numbers in an element; None where there are not as many as there should be."""
    reader = ValueReader()
    read = reader.numbers_in(element.text)
    return read if len(read) == count and not reader.faults else None


def _write(draft: Draft, read: Sequence[Located[float]], values: Sequence[float]) -> None:
    for number, value in zip(read, values, strict=True):
        if abs(number.value - value) > _SAME:
            draft.put(number.span, _number(value))


def _differs(one: Transform, other: Transform) -> bool:
    pairs = zip(_entries(one), _entries(other), strict=True)
    return any(abs(a - b) > _SAME for a, b in pairs)


def _entries(pose: Transform) -> Iterator[float]:
    yield from pose.translation
    for row in pose.rotation:
        yield from row


def _text(values: Sequence[float]) -> str:
    return " ".join(map(_number, values))


def _number(value: float) -> str:
    """Write a number; quarter turns to 16 digits, and no trace of rounding."""
    quarters = round(value / (math.pi / 2))
    if quarters and abs(value - quarters * (math.pi / 2)) < _SAME:
        return repr(quarters * (math.pi / 2))
    text = repr(round(value, _DIGITS) + 0.0)
    return text.removesuffix(".0")
