"""Writer of converted documents: numbers, poses, elements, indentation of two blanks."""

from __future__ import annotations

import copy
import math
from collections.abc import Iterable
from decimal import Decimal

from lxml import etree

from checker.model.components import Pose
from checker.model.geometry.transform import Transform
from checker.source.text import Located

NOISE = 1e-15
"""Metres or radians (and entries of rotations) below which a number is what rounding left."""
_PLAIN = (1e-9, 1e16)
"""Numbers between these are written without exponent."""
_SHORTER = 4
"""Characters that a rounded number must save before it counts as the intended one."""


def document_text(tree: etree._Element) -> str:
    """Return a document's text, indented by two blanks, with declaration and a last line end."""
    written = copy.deepcopy(tree)
    etree.indent(written, space="  ")
    written.tail = None
    text = etree.tostring(written, encoding="unicode")
    return f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n'


def exact(value: float) -> str:
    """Return the shortest decimal that reads back as the same number."""
    value = float(value)
    if value == 0.0:
        return "0"
    text = repr(value)
    if _PLAIN[0] <= abs(value) < _PLAIN[1]:
        text = format(Decimal(text), "f")
    return text.removesuffix(".0")


def number(value: float) -> str:
    """Return a length or angle: the same as `exact`, without what rounding left behind.

    Below `NOISE` it is 0, and 0.30000000000000004 is 0.3.
    """
    if not math.isfinite(value):
        return exact(value)
    if abs(value) < NOISE:
        return "0"
    text, short = exact(value), exact(round(value, 14))
    return short if len(short) + _SHORTER <= len(text) and "e" not in text else text


def tidy(value: float) -> str:
    """Return a sum, as of masses, without what rounding left in its last digits."""
    text = exact(value)
    short = exact(float(f"{value:.14g}"))
    return short if len(short) + _SHORTER <= len(text) else text


def numbers(values: Iterable[float]) -> str:
    """Return lengths or angles with blanks between them."""
    return " ".join(map(number, values))


def exact_numbers(values: Iterable[Located[float]]) -> str:
    """Return numbers of the source as they are."""
    return " ".join(exact(value.value) for value in values)


def six_numbers(pose: Transform, stated: Pose | None = None) -> tuple[str, str]:
    """Return x y z (metres) and roll pitch yaw (radians) of a pose.

    Args:
        pose: What to write.
        stated: The pose of the source; where it is the same, its numbers are taken as written.
    """
    if stated is not None and _has_six_numbers(stated) and pose.is_near(stated.transform, NOISE):
        return exact_numbers(stated.numbers[:3]), exact_numbers(stated.numbers[3:])
    return numbers(pose.translation), numbers(pose.rpy)


def _has_six_numbers(stated: Pose) -> bool:
    """Return whether a pose is stated with six numbers; one of a URDF may not be stated at all."""
    return stated.in_radians and len(stated.numbers) == 6


def add(parent: etree._Element, tag: str, text: str = "", **attributes: str) -> etree._Element:
    """Add an element at the end of another one; an attribute `type_` is written `type`."""
    named = {name.removesuffix("_"): value for name, value in attributes.items()}
    child = etree.SubElement(parent, tag, named)
    if text:
        child.text = text
    return child


def child_of(parent: etree._Element, *path: str) -> etree._Element:
    """Return the element at a path below another one; what is missing is added."""
    at = parent
    for tag in path:
        child = at.find(tag)
        at = child if child is not None else etree.SubElement(at, tag)
    return at


def is_identity(pose: Transform) -> bool:
    """Return whether a pose is that of the frame itself, up to rounding."""
    return pose.is_near(Transform(), NOISE)


def unique(name: str, taken: dict[str, int]) -> str:
    """Return a name that is not taken, with a number behind it if needed, and take it.

    Args:
        name: Wanted.
        taken: Names in use, each with the last number that was tried behind it.
    """
    chosen = name
    while chosen in taken:
        taken[name] += 1
        chosen = f"{name}_{taken[name]}"
    taken[chosen] = 0
    return chosen
