"""The tags of roslaunch XML (`checker/data/roslaunch_tags.json`), and attributes gone astray."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache

from checker.record import record
from checker.resources import table
from checker.source.text import Located, Span
from checker.source.xml import Element

_LEFT_OUTSIDE = re.compile(
    r"""\s*([A-Za-z][\w-]{0,40})\s{0,20}=\s{0,20}(["'])([^"'<>]{0,2000})\2"""
)


@record()
class LaunchTag:
    """What roslaunch knows of one tag.

    Attributes:
        attributes: Names of its attributes, conditions among them.
        required: Those without which roslaunch stops.
        children: Tags that may stand inside.
    """

    attributes: frozenset[str]
    required: tuple[str, ...]
    children: frozenset[str]


@cache
def launch_tags() -> Mapping[str, LaunchTag]:
    """Return the tags that roslaunch knows, by name."""
    known = table("roslaunch_tags")
    return {
        name: LaunchTag(
            frozenset(entry["attributes"]).union(() if name == "launch" else known["_conditions"]),
            tuple(entry["required"]),
            frozenset(entry["children"]),
        )
        for name, entry in known.items()
        if not name.startswith("_")
    }


def left_outside(element: Element) -> dict[str, Located[str]]:
    """Return the attributes that stand behind a tag which was closed too early.

    In `<node> pkg="p" type="t" name="n">` the text behind the first `>` is what the tag should
    hold. Elements that have attributes of their own, or whose text is a value, have none.
    """
    if element.node.attrib or element.tag not in ("node", "include") or "=" not in element.raw_text:
        return {}
    start, text = element.position.start_end, element.raw_text
    found: dict[str, Located[str]] = {}
    at = 0
    while match := _LEFT_OUTSIDE.match(text, at):
        span = Span(element.source, start + match.start(3), start + match.end(3), element)
        exact = span.text == match.group(3)
        found.setdefault(match.group(1), Located(match.group(3), span if exact else element.span))
        at = match.end()
    return found
