"""Names of nested parts: in the flat model, in plugins, and in other files of the package."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from checker.base.record import Record
from checker.base.resources import table
from checker.finding import Edit
from checker.model.components import Frame, Joint, Link, Model, Plugin
from checker.model.frames import MODEL_FRAME
from checker.model.robot import Robot
from checker.source.text import Located, SourceText, Span

# What names a link, a joint or a frame in the parameters of a plugin.


_NAMING = re.compile("joint|link", re.IGNORECASE)


def names_in(plugin: Plugin) -> Iterator[Located[str]]:
    """Yield the texts that may name a part of the robot.

    Of a plugin whose parameters are not known, those that are called after joints or links, and
    names that lead into a nested model.
    """
    known = table("plugin_references")["plugins"].get(plugin.class_name)
    sure = [named for path in known or () for named in plugin.at(path)]
    yield from sure
    places = {named.span.start for named in sure}
    for name, text in _texts(plugin):
        naming = "::" in text.value or (known is None and _NAMING.search(name) is not None)
        if naming and text.span.start not in places:
            yield text


def _texts(plugin: Plugin) -> Iterator[tuple[str, Located[str]]]:
    """Yield all texts and attributes below a plugin with the names they have."""
    for element in plugin.element.descendants():
        if element.text.stated:
            yield element.tag, element.text
        for name in element.attributes:
            attribute = element.attribute(name)
            if attribute is not None:
                yield name, attribute


SEPARATOR = "__"
"""Separates the name of a model from those of its parts, as in `arm__wrist`."""
_SCOPE = "::"


class FlatNames(Record):
    """New names by scoped names; what is in the outermost model keeps its own."""

    changed: Mapping[str, str]

    @classmethod
    def from_robot(cls, robot: Robot) -> FlatNames:
        """Name the parts of a robot's nested models."""
        taken = {MODEL_FRAME, *_names(robot, nested=False)}
        changed: dict[str, str] = {}
        numbers: dict[str, int] = {}
        for scoped in dict.fromkeys(_names(robot, nested=True)):
            flat = base_name = scoped.replace(_SCOPE, SEPARATOR)
            while flat in taken:
                numbers[base_name] = numbers.get(base_name, 1) + 1
                flat = f"{base_name}_{numbers[base_name]}"
            taken.add(flat)
            changed[scoped] = flat
        return cls(changed)

    def flat_name(self, scoped: str) -> str:
        """Return the name that replaces a scoped one; itself where no part changes that name."""
        return self.changed.get(scoped, scoped)


def _names(robot: Robot, *, nested: bool) -> Iterator[str]:
    """Yield the scoped names of what is in nested models, or of what is not."""
    parts: tuple[Model | Link | Frame | Joint, ...] = (*robot.models, *robot.links)
    for part in (*parts, *robot.frames, *robot.joints):
        # A nested model leaves its name to the frame that stands where it stood.
        stays = part.element.parent is robot.element and not isinstance(part, Model)
        if nested is not stays:
            yield part.scoped_name


# Names of nested parts in other files of a package: topics of bridges, frames of transforms.


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
    for match in _SCOPED.finditer(source.text):
        for scoped, start in _suffixes(match.group()):
            if scoped in names.changed:
                span = Span(source, match.start() + start, match.end())
                yield scoped, span.replacement(names.flat_name(scoped))
                break
    for match in _TOPIC.finditer(source.text):
        steps = match.group(1).removesuffix("/").split("/")[1::2]
        for number in range(len(steps)):
            scoped = "::".join((*steps[number:], match.group(3)))
            if scoped in names.changed:
                before = sum(len(f"model/{step}/") for step in steps[:number])
                span = Span(source, match.start() + before, match.end())
                yield scoped, span.replacement(f"{match.group(2)}/{names.flat_name(scoped)}")
                break


def topic_mentions(source: SourceText, names: FlatNames) -> Iterator[Edit]:
    """Yield edits of topics that name a part directly, such as `link/X1/base_link/sensor/imu`."""
    for match in _STEPS.finditer(source.text):
        steps = match.group(1).split("/")
        for number in range(min(len(steps), _DEPTH), 0, -1):
            named = "/".join(steps[:number])
            if named in names.changed:
                span = Span(source, match.start(1), match.start(1) + len(named))
                yield span.replacement(names.flat_name(named))
                break


def _suffixes(scoped: str) -> Iterator[tuple[str, int]]:
    """Yield a scoped name, then without the names in front, each with where it starts."""
    start = 0
    for _ in range(_DEPTH):
        yield scoped[start:], start
        start = scoped.find("::", start) + 2
        if start < 2 or "::" not in scoped[start:]:
            return
