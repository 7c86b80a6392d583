"""Names of nested parts in other files of a package: topics of bridges, frames of transforms."""

from __future__ import annotations

import re
from collections.abc import Iterator

from checker.finding import Edit
from checker.fix.flattening.names import FlatNames
from checker.source.text import SourceText, Span

SUFFIXES = (".launch", ".rb", ".yaml", ".yml", ".urdf", ".xacro")
"""Files that name parts of the robot."""

_DEPTH = 8
_SCOPED = re.compile(r"(?<![\w.:-])[\w.-]+(?:::[\w.-]+){1,40}")
_TOPIC = re.compile(r"((?:(?<![\w-])model/[^/\s\"'<>]{1,200}/){1,8})(link|joint)/([\w.-]{1,200})")
_STEPS = re.compile(r"(?<![\w-])(?:link|joint)/([\w./-]{1,300})")


def mentions(source: SourceText, names: FlatNames) -> Iterator[tuple[str, Edit]]:
    """Yield the nested parts that a text names, each with the edit that gives it its new name.

    A part is named `arm::wrist`, or `model/arm/link/wrist` as in the topics of its sensors.
    """
    for found in _SCOPED.finditer(source.text):
        for scoped, start in _suffixes(found.group()):
            if scoped in names.changed:
                span = Span(source, found.start() + start, found.end())
                yield scoped, span.replaced_by(names.flat(scoped))
                break
    for found in _TOPIC.finditer(source.text):
        steps = found.group(1).removesuffix("/").split("/")[1::2]
        for number in range(len(steps)):
            scoped = "::".join((*steps[number:], found.group(3)))
            if scoped in names.changed:
                before = sum(len(f"model/{step}/") for step in steps[:number])
                span = Span(source, found.start() + before, found.end())
                yield scoped, span.replaced_by(f"{found.group(2)}/{names.flat(scoped)}")
                break


def topic_mentions(source: SourceText, names: FlatNames) -> Iterator[Edit]:
    """Yield edits of topics that name a part directly, such as `link/X1/base_link/sensor/imu`."""
    for found in _STEPS.finditer(source.text):
        steps = found.group(1).split("/")
        for number in range(min(len(steps), _DEPTH), 0, -1):
            named = "/".join(steps[:number])
            if named in names.changed:
                span = Span(source, found.start(1), found.start(1) + len(named))
                yield span.replaced_by(names.flat(named))
                break


def _suffixes(scoped: str) -> Iterator[tuple[str, int]]:
    """Yield a scoped name, then without the names in front, each with where it starts."""
    start = 0
    for _ in range(_DEPTH):
        yield scoped[start:], start
        start = scoped.find("::", start) + 2
        if start < 2 or "::" not in scoped[start:]:
            return
