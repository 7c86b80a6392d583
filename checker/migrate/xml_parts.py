"""Small pieces of SDF, written and looked up."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Union

from lxml import etree

from checker.convert.writing import exact
from checker.model.values import parse_number

Content = Union[str, int, float, "Tree"]
Tree = Mapping[str, Content]
"""Elements by tag; `@name` is an attribute."""


def build(tag: str, content: Content) -> etree._Element:
    """Return an element that holds what a mapping says."""
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
        for each in old:
            parent.remove(each)
    else:
        parent.append(new)
    return new


def drop(parent: etree._Element, *tags: str) -> None:
    """Remove the children of some tags."""
    for child in [each for each in parent if each.tag in tags]:
        parent.remove(child)


def number_at(parent: etree._Element, path: str, default: float) -> float:
    """Return the finite number at a path below; the default where there is none."""
    value = parse_number(parent.findtext(path) or "")
    return default if value is None or not math.isfinite(value) else value


def _text(value: str | int | float) -> str:
    return value if isinstance(value, str) else exact(float(value))
