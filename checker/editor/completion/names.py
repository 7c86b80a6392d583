"""Names of links, joints, frames and sensors, where XML needs one."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from checker.editor.completion.item import Completion, CompletionKind, Request
from checker.editor.figures import number
from checker.editor.name_kinds import name_kinds
from checker.editor.names.mention import NameKind
from checker.editor.robot_parts import RobotPart, robot_parts
from checker.model.components import Joint, Link, Sensor

_DECLARED = re.compile(
    r"""<(link|joint|frame|model|sensor)\s[^<>]*?\bname\s*=\s*(?:"([^"<]*)"|'([^'<]*)')"""
)
_SPECIAL = {"parent": ("world",), "relative_to": ("__model__",), "expressed_in": ("__model__",)}
_LIMIT = 2000
"""Names of one kind that are offered."""


def names(request: Request) -> Iterator[Completion]:
    """Yield the names that may be at the caret; nothing if it is no place for one."""
    xml = request.xml
    tags = (*xml.tags, xml.tag) if xml.tag else xml.tags
    plugin = request.plugin.attributes.get("name", "") if request.plugin is not None else ""
    kinds = name_kinds(tags, xml.attribute, plugin.rpartition("::")[2])
    if not kinds:
        return
    known: set[str] = set()
    parts = robot_parts(request.subject, request.path)
    scope = _scope(request)
    for rank, kind in enumerate(kinds):
        for name, part in islice(parts.names(kind), _LIMIT):
            known.add(part.part.name.value)
            at = 1 + rank if name.startswith(scope) else 6
            shown, detail = name.removeprefix(scope), _detail(part)
            yield request.item(shown, CompletionKind(kind.value), detail=detail, rank=at)
    for name, kind in islice(_declared(request.text), _LIMIT):
        if kind in kinds and name and name not in known:
            yield request.item(name, CompletionKind(kind.value), rank=1 + kinds.index(kind))
    for name in _SPECIAL.get(xml.attribute or tags[-1], ()):
        if request.own_place.language == "sdf":
            yield request.item(name, CompletionKind.FRAME, rank=8)


def _declared(text: str) -> Iterator[tuple[str, NameKind]]:
    """Yield the names that the text declares as it is."""
    for match in _DECLARED.finditer(text):
        name = match[2] if match[2] is not None else match[3]
        yield name, NameKind(match[1])


def _scope(request: Request) -> str:
    """Return what is in front of scoped names of the models around the caret."""
    models = [it.attributes.get("name", "") for it in request.xml.around if it.tag == "model"]
    return "".join(f"{name}::" for name in models[1:])


def _detail(known: RobotPart) -> str:
    match known.part:
        case Link() as link:
            return f"link, {number(link.mass)} kg"
        case Joint() as joint:
            return f"{joint.type.value} joint"
        case Sensor() as sensor:
            return f"{sensor.type.value} sensor"
        case _:
            return ""
