"""Small pieces of SDF, written and looked up."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Union

from lxml import etree

from checker.convert.xml_writer import exact
from checker.formats.sdf.poses import in_degrees
from checker.model.values import parse_number

# Angles that mean a multiple of π/2, written to 16 digits as the guide asks.


TOLERANCE = 1e-3
"""Radians: 1.57, 1.5708 and 3.1416 are meant, 1.56 is not."""
_PRECISE = 1e-15
"""Radians a quarter turn, that the 16th digit represents."""
_NUMBERS = 6


def sharpen_angles(tree: etree._Element) -> list[str]:
    """Write out the angles of poses; return a sentence about those of which digits were missing."""
    changed = 0
    for pose in tree.iter("pose"):
        words = (pose.text or "").split()
        if len(words) != _NUMBERS or in_degrees(pose):
            continue
        sharp = [_sharp(word) for word in words[3:]]
        if sharp != words[3:]:
            pose.text = " ".join([*words[:3], *sharp])
            changed += 1
    if not changed:
        return []
    poses = "1 pose is" if changed == 1 else f"{changed} poses are"
    return [f"{poses} written with 16 digits where an angle means a multiple of π/2"]


def _sharp(word: str) -> str:
    angle = parse_number(word)
    if angle is None or not math.isfinite(angle):
        return word
    quarters = round(angle / (math.pi / 2))
    meant = quarters * (math.pi / 2)
    off = abs(angle - meant)
    if quarters == 0 or off <= _PRECISE * abs(quarters) or off >= TOLERANCE:
        return word
    return f"{meant:.16f}"


Content = Union[str, int, float, "Tree"]
Tree = Mapping[str, Content]
"""Elements by tag; `@name` is an attribute."""


def build(tag: str, content: Content) -> etree._Element:
    """Return an element with the content of a mapping."""
    element = etree.Element(tag)
    if not isinstance(content, Mapping):
        element.text = _text(content)
        return element
    for name, inside in content.items():
        if name.startswith("@"):
            element.set(name[1:], str(inside))
        else:
            element.append(build(name, inside))
    return element


def put(parent: etree._Element, tag: str, content: Content) -> etree._Element:
    """Replace the children of a tag by one with this content, at the place of the first."""
    new = build(tag, content)
    old = parent.findall(tag)
    if old:
        parent.insert(parent.index(old[0]), new)
        for child in old:
            parent.remove(child)
    else:
        parent.append(new)
    return new


def drop(parent: etree._Element, *tags: str) -> None:
    """Remove the children of some tags."""
    for child in [node for node in parent if node.tag in tags]:
        parent.remove(child)


def number_at(parent: etree._Element, path: str, default: float) -> float:
    """Return the finite number at a path below; the default where there is none."""
    value = parse_number(parent.findtext(path) or "")
    return default if value is None or not math.isfinite(value) else value


def _text(value: str | int | float) -> str:
    return value if isinstance(value, str) else exact(float(value))
