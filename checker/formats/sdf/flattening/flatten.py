"""A robot of nested models and includes as one flat model: the edits of its file.

Elements are moved as they are written, and only what depends on where they are is changed.
"""

from __future__ import annotations

import posixpath
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import cached_property

from checker.base.record import Record
from checker.finding import Edit
from checker.formats.sdf.document import sdf_version
from checker.formats.sdf.flattening import poses
from checker.formats.sdf.flattening.draft import Draft, Holder, escape_xml
from checker.formats.sdf.flattening.names import SEPARATOR, FlatNames, names_in
from checker.formats.sdf.flattening.poses import pose_text
from checker.formats.sdf.links import read_plugin
from checker.model.components import Frame, Joint, Link, Model
from checker.model.faults import FaultKind
from checker.model.frames import MODEL_FRAME
from checker.model.geometry.transform import Transform
from checker.model.robot import Robot
from checker.source.text import Located, SourceText
from checker.source.xml import Element
from checker.source.xml_insertion import indentation_of, newline_of, with_blanks

# Why a robot cannot be flattened by text edits that surely mean the same.


LIMIT = 20_000_000
"""Characters of all nested models together: files that include each other often grow fast."""

_NO_NAMES = ("", MODEL_FRAME, "world")

_MEANINGS = ((1, 5), (1, 7))
"""SDF versions that changed which frame an axis or a pose is written in."""


def obstacle(robot: Robot) -> str:
    """Return the reason, as the end of a sentence; empty if it can be flattened."""
    return next(_obstacles(robot), "")


def _obstacles(robot: Robot) -> Iterator[str]:
    if robot.missing_parts:
        yield robot.missing_parts
    posed: tuple[Link | Frame | Model | Joint, ...] = (*robot.links, *robot.frames, *robot.models)
    for parts in (posed, robot.joints):
        if any(part.name.value in _NO_NAMES for part in parts):
            yield "a part has no name of its own"
        names = Counter(part.scoped_name for part in parts)
        for name in (name for name, number in names.items() if number > 1):
            yield f"two parts are called {name}"
    for fault in robot.faults:
        if fault.kind in (FaultKind.FRAME, FaultKind.INCLUDE):
            yield fault.message
    yield from _other_versions(robot)
    for name in robot.frame_graph.nodes:
        if robot.pose_of(name) is None:
            yield f"the place of {name} is not known"
    if sum(len(model.definition.whole_span.text) for model in robot.models) > LIMIT:
        yield f"its nested models have more than {LIMIT} characters"


def _other_versions(robot: Robot) -> Iterator[str]:
    own = sdf_version(robot.document)
    for model in robot.models:
        version = sdf_version(model.definition.document)
        newer = version > own >= _MEANINGS[-1]
        if newer or any((version < change) is not (own < change) for change in _MEANINGS):
            theirs, ours = ".".join(map(str, version)), ".".join(map(str, own))
            yield f"{model.definition.source.file} is written in SDF {theirs}, not in {ours}"


# From SDF 1.7 on: what was written in a nested model's frame names a frame that replaces it.


def move_part(draft: Draft, part: Element, holder: Holder, names: FlatNames) -> None:
    """Pose a link or frame relative to the frame of the model that contained it."""
    frame = names.flat_name(holder.frame)
    if part.tag == "frame" and not part.get("attached_to"):
        draft.attribute(part, "attached_to", frame)
    elif part.tag == "link":
        pose = part.child("pose")
        if pose is None:
            draft.insert(part, f'<pose relative_to="{escape_xml(frame)}">0 0 0 0 0 0</pose>')
        elif not pose.get("relative_to"):
            draft.attribute(pose, "relative_to", frame)


def standing_frame(name: str, pose: Transform, attached_to: str) -> list[str]:
    """Return the lines of the frame that is where a model stood.

    Args:
        name: What it is called.
        pose: The pose in the robot's frame.
        attached_to: The model's canonical link; empty for none.
    """
    tied = f' attached_to="{escape_xml(attached_to)}"' if attached_to else ""
    return [
        f'<frame name="{escape_xml(name)}"{tied}>',
        f'  <pose relative_to="{MODEL_FRAME}">{pose_text(pose)}</pose>',
        "</frame>",
    ]


# Lines moved from one depth, or one file, to another.


_BLANKS = " \t"


def lines_of(draft: Draft, start: int, end: int) -> list[str]:
    """Return what a draft makes of a stretch: lines, the first of them without indentation."""
    before = draft.source.text[draft.source.text.rfind("\n", 0, start) + 1 : start]
    outer = before if not before.strip() else ""
    lines = (outer + draft.text(start, end)).replace("\r\n", "\n").split("\n")
    while lines and not lines[0].strip():
        lines.pop(0)
    while lines and not lines[-1].strip():
        lines.pop()
    if not lines:
        return []
    shared = lines[0][: len(lines[0]) - len(lines[0].lstrip(_BLANKS))]
    lines[-1] = lines[-1].rstrip(_BLANKS)
    return [line.removeprefix(shared) if line.strip() else "" for line in lines]


def put_in_place_of(element: Element, lines: Sequence[str]) -> str:
    """Return lines as they are where an element stood, whose own indentation stays."""
    indentation = indentation_of(element.source, element.position.start) or ""
    newline = newline_of(element.source, element.position.start)
    if " " in indentation:
        lines = [_without_tabs(line) for line in lines]
    first, *others = lines or [""]
    return first + "".join(newline + indentation * bool(line) + line for line in others)


def _without_tabs(line: str) -> str:
    """Return a line of another file with blanks in front, as they are around it."""
    text = line.lstrip(_BLANKS)
    return line[: len(line) - len(text)].replace("\t", "  ") + text


_PARTS = ("link", "frame", "joint")
_OF_A_MODEL = ("pose", "static", "self_collide", "allow_auto_disable", "enable_wind")
"""Properties of a nested model that the robot has for all its parts."""
_FRAMES_TOO = (1, 7)
"""SDF version from which on poses can name the frame that they are written in."""


class Flattening(Record, dict=True):
    """A robot and the names of its parts; `obstacle` must have found nothing."""

    robot: Robot
    names: FlatNames

    @property
    def edits(self) -> tuple[Edit, ...]:
        """The edits of the robot's own file."""
        model = self.robot.element
        draft = Draft(self.robot.document.source)
        canonical = model.attribute("canonical_link")
        if canonical is not None:
            draft.name(canonical, self.names.flat_name(canonical.value))
        self._move(draft, Holder(model))
        return draft.edits

    @cached_property
    def _models(self) -> dict[tuple[Element, str], Model]:
        return {(model.element, model.scope): model for model in self.robot.models}

    @cached_property
    def _uris(self) -> dict[tuple[SourceText, int], Located[str]]:
        """The paths to files, by where they are."""
        return {(uri.span.source, uri.span.start): uri for uri in self.robot.file_uris}

    @cached_property
    def _by_frames(self) -> bool:
        return sdf_version(self.robot.document) >= _FRAMES_TOO

    def _move(self, draft: Draft, holder: Holder) -> None:
        """Move the parts of a model to the robot."""
        for child in holder.element.children:
            if child.tag in ("model", "include"):
                self._flatten(draft, child, holder)
            elif child.tag in _PARTS:
                self._move_part(draft, child, holder)
            elif child.tag == "plugin":
                self._rename_in_plugin(draft, child, holder)
            elif child.tag == "gripper":
                self._rename_gripper(draft, child, holder)
            elif child.tag in _OF_A_MODEL and holder.nested:
                draft.take_out(child.whole_span)

    def _flatten(self, draft: Draft, element: Element, around: Holder) -> None:
        """Put the parts of a nested model in its place."""
        model = self._models[element, around.prefix]
        inside = Holder(model.definition, model.prefix, model.scoped_name)
        inner = Draft(model.definition.source)
        self._move(inner, inside)
        lines = self._standing_frame(model) if self._by_frames else []
        position = model.definition.position
        lines += lines_of(inner, position.start_end, position.end_start)
        for plugin in element.all("plugin") if element.tag == "include" else ():
            added = Draft(element.source)
            self._rename_in_plugin(added, plugin, inside)
            lines += lines_of(added, plugin.position.start, plugin.position.end)
        span = element.whole_span if lines else with_blanks(element.whole_span)
        draft.put(span, put_in_place_of(element, lines))

    def _standing_frame(self, model: Model) -> list[str]:
        pose = self.robot.pose_of(model.scoped_name) or Transform()
        name = self.names.flat_name(model.scoped_name)
        return standing_frame(name, pose, next(self._links_of(model), ""))

    def _links_of(self, model: Model) -> Iterator[str]:
        """Yield the new names of a model's canonical link and of all its links."""
        if stated := model.definition.get("canonical_link"):
            yield self.names.flat_name(model.prefix + stated)
        for link in model.definition.all("link"):
            yield self.names.flat_name(model.prefix + (link.get("name") or ""))
        for child in model.definition.children:
            if inner := self._models.get((child, model.prefix)):
                yield from self._links_of(inner)

    def _move_part(self, draft: Draft, part: Element, holder: Holder) -> None:
        if holder.nested and not self._by_frames:
            poses.move_part(draft, part, holder, self.robot)
        elif holder.nested:
            move_part(draft, part, holder, self.names)
        holder.rename(draft, part, self.names)
        if holder.element.source is not self.robot.document.source:
            self._move_uris(draft, part)

    def _move_uris(self, draft: Draft, part: Element) -> None:
        """Write paths that start at another file's folder so that they start at the robot's."""
        own = posixpath.dirname(self.robot.document.source.file)
        for element in part.descendants():
            uri = self._uris.get((element.source, element.text.span.start))
            if uri is not None and ":" not in uri.value and not uri.value.startswith("/"):
                path = posixpath.join("/", "_", Robot.folder_of(uri), uri.value)
                draft.name(uri, posixpath.relpath(path, posixpath.join("/", "_", own)))

    def _rename_in_plugin(self, draft: Draft, element: Element, holder: Holder) -> None:
        for named in names_in(read_plugin(element)):
            scoped = holder.scoped(named.value)
            known = scoped if scoped in self.names.changed else named.value
            draft.name(named, self.names.flat_name(known))

    def _rename_gripper(self, draft: Draft, element: Element, holder: Holder) -> None:
        holder.rename(draft, element, self.names)
        name = element.attribute("name")
        if name is not None and holder.nested:
            draft.name(name, f"{self.names.flat_name(holder.frame)}{SEPARATOR}{name.value}")
