"""Hover text at an offset of a file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from checker.base.record import Record
from checker.base.words import count
from checker.editor.card import card, code, escaped_words, names
from checker.editor.hover.elements import element_card
from checker.editor.hover.expressions import (
    Expression,
    expression_at,
    expression_card,
    include_card,
    tag_card,
)
from checker.editor.hover.joints import joint_card
from checker.editor.hover.links import link_card
from checker.editor.hover.meshes import file_card
from checker.editor.hover.models import frame_card, robot_card
from checker.editor.hover.plugins import hardware_card, parameter_card, plugin_card
from checker.editor.hover.pointed import Pointed, ancestry, pointed_at
from checker.editor.hover.sensors import sensor_card
from checker.editor.language import place_of
from checker.editor.name_kinds import name_kinds
from checker.editor.names.mention import NameKind
from checker.editor.robot_parts import RobotPart, RobotParts, robot_parts
from checker.editor.target import schema_version, usual_target
from checker.editor.xacro_names import PREFIX, XacroNames, xacro_names
from checker.editor.xml_context import Where
from checker.engine.subject import Subject
from checker.formats.sdf.includes import ModelIncludes, included_model
from checker.formats.sdf.reader import read_robot
from checker.model.components import Joint, Link, Plugin, Sensor
from checker.model.robot import Robot
from checker.rule import Context
from checker.source.xml import Element, XmlDocument

_FILE_TAGS = ("uri", "albedo_map", "normal_map", "roughness_map", "metalness_map")


class Hover(Record):
    """Hover text and the span to which it applies.

    Attributes:
        markdown: The text.
        start: Offset of the thing under the pointer.
        end: Offset behind it.
    """

    markdown: str
    start: int
    end: int


def hover_at(
    subject: Subject, path: str, offset: int, target: Context | None = None
) -> Hover | None:
    """Return what is known of the thing at an offset; None if there is nothing to state.

    Args:
        subject: The package.
        path: The path of an XML file, relative to the package.
        offset: The offset in characters of its text.
        target: What the package is judged for; its usual target where it is None.
    """
    document = subject.package.xml(path)
    if not isinstance(document, XmlDocument):
        return None
    pointed = pointed_at(document, offset)
    if pointed is None:
        return None
    search = _Search(subject, path, pointed, target or usual_target(subject.package))
    return next(search.hovers(offset), None)


class _Search:
    """Candidates for the hover text of one thing, the most important first."""

    def __init__(self, subject: Subject, path: str, pointed: Pointed, target: Context) -> None:
        self.subject, self.path, self.pointed, self.target = subject, path, pointed, target

    @property
    def names(self) -> XacroNames:
        return xacro_names(self.subject.package, self.path)

    def hovers(self, offset: int) -> Iterator[Hover]:
        expression = expression_at(self.pointed, offset)
        if expression is not None:
            yield from self._of_expression(expression)
        if (text := self._text()) is not None:
            yield Hover(text, self.pointed.span.start, self.pointed.span.end)

    def _of_expression(self, expression: Expression) -> Iterator[Hover]:
        parts = robot_parts(self.subject, self.path)
        text = expression_card(expression, self.pointed, self.names, parts)
        if text is None:
            return
        if not self.pointed.element.tag.startswith(PREFIX) and (part := self._of_parts()):
            text = f"{text}\n\n---\n\n{part}"
        yield Hover(text, expression.start, expression.end)

    def _text(self) -> str | None:
        element = self.pointed.element
        if element.tag.startswith(PREFIX) and not _names_file(self.pointed):
            return self._of_xacro()
        if _names_file(self.pointed):
            return self._of_file()
        return self._of_parts() or self._of_plugin() or self._of_schema()

    def _of_xacro(self) -> str | None:
        is_name = self.pointed.where is Where.TAG or self.pointed.attribute in ("name", "macro")
        return tag_card(self.pointed.element, self.names) if is_name else None

    def _of_parts(self) -> str | None:
        """Return what is known of the part that is pointed at, or that is named there."""
        element, where = self.pointed.element, self.pointed.where
        is_name = where is Where.TAG or (where is Where.VALUE and self.pointed.attribute == "name")
        kinds = self._kinds() if where in (Where.VALUE, Where.TEXT) else ()
        if not (is_name and not kinds) and not kinds:
            return None
        parts = robot_parts(self.subject, self.path)
        if kinds:
            scopes = _scopes(element)
            found = (parts.part_named(name, kinds, scopes) for name in self._values(parts))
            named = next((part for part in found if part is not None), None)
            return None if named is None else self._card(named)
        described = parts.parts_of(element)
        return self._card(described[0], _others(described)) if described else None

    def _values(self, parts: RobotParts) -> Iterator[str]:
        """Yield what the attribute or text states, after xacro where that reads it."""
        if "$" not in self.pointed.value:
            yield self.pointed.value.strip()
            return
        for copy in parts.copies_of(self.pointed.element):
            of_text = self.pointed.where is Where.TEXT
            yield copy.value if of_text else copy.attributes.get(self.pointed.attribute, "")

    def _of_file(self) -> str | None:
        element, attribute = self.pointed.element, self.pointed.attribute
        if element.tag == "uri" and element.parent is not None and element.parent.tag == "include":
            return self._of_include(element.parent)
        if element.tag.startswith(PREFIX):
            return include_card(self.subject.package, element)
        if "$" in self.pointed.value:
            copies = robot_parts(self.subject, self.path).copies_of(element)
            element = next(copies, element)
            if element is self.pointed.element:
                return None
        uri = element.attribute(attribute) if attribute else element.text
        return None if uri is None else file_card(self.subject, uri, _scale(element))

    def _of_include(self, element: Element) -> str:
        """Return what is known of the model that an `<include>` puts in."""
        described = robot_parts(self.subject, self.path).parts_of(element)
        if described:
            return self._card(described[0])
        found = included_model(element, ModelIncludes(self.subject.package))
        if isinstance(found, str):
            return card(f"**include** {code(self.pointed.value)}", [], f"{escaped_words(found)}.")
        return robot_card(read_robot(found, ModelIncludes(self.subject.package)))

    def _kinds(self) -> Sequence[NameKind]:
        plugin = _plugin_around(self.pointed.element)
        last = (plugin.get("name") or "").rpartition("::")[2] if plugin is not None else ""
        return name_kinds(self.pointed.tags, self.pointed.attribute, last)

    def _card(self, known: RobotPart, note: str = "") -> str:
        match known.part:
            case Link() as link:
                return link_card(known.robot, link, note)
            case Joint() as joint:
                return joint_card(known.robot, joint, note)
            case Sensor() as sensor:
                return sensor_card(self.subject, known.robot, sensor, note)
            case Plugin() as plugin:
                return plugin_card(plugin.element, self.target, note)
            case Robot() as robot:
                return robot_card(robot, note)
            case frame:
                return frame_card(known.robot, frame, note)

    def _of_plugin(self) -> str | None:
        element, pointed = self.pointed.element, self.pointed
        plugin = _plugin_around(element)
        if pointed.where is Where.TEXT and pointed.tags[-2:] == ("hardware", "plugin"):
            return hardware_card(pointed.value)
        if plugin is None:
            of_plugin = pointed.where is Where.TAG or pointed.attribute in ("name", "filename")
            is_one = element.tag == "plugin" and of_plugin and element.get("filename") is not None
            return plugin_card(element, self.target) if is_one else None
        below = pointed.tags[len(list(ancestry(plugin))) :]
        steps = (*below, f"@{pointed.attribute}") if pointed.attribute else below
        return parameter_card(plugin, "/".join(steps), pointed.value, self.target)

    def _of_schema(self) -> str | None:
        element = self.pointed.element
        place = place_of(self.pointed.tags, refers=_refers(element))
        stated = (element.document.root.get("version") or "").strip()
        version = schema_version(stated if not place.is_extension else "", self.target)
        return element_card(element.tag, place, self.pointed.attribute, version, self.target)


def _plugin_around(element: Element) -> Element | None:
    above = ancestry(element)
    next(above)
    return next((it for it in above if it.tag == "plugin"), None)


def _refers(element: Element) -> bool:
    """Return whether the `<gazebo>` tag around an element refers to a link or joint."""
    gazebo = next((it for it in ancestry(element) if it.tag == "gazebo"), None)
    return gazebo is not None and bool(gazebo.get("reference"))


def _names_file(pointed: Pointed) -> bool:
    """Return whether the URI of a file is pointed at."""
    if pointed.where is Where.TEXT:
        return pointed.element.tag in _FILE_TAGS
    named = pointed.where is Where.VALUE and pointed.attribute == "filename"
    return named and pointed.element.tag in ("mesh", "texture", f"{PREFIX}include")


def _scale(element: Element) -> tuple[float, ...]:
    """Return the scale of the mesh that an element names."""
    mesh = element if element.tag == "mesh" else element.parent
    stated = mesh.child("scale") if mesh is not None else None
    text = stated.value if stated is not None else (mesh.get("scale") or "") if mesh else ""
    try:
        numbers = tuple(float(word) for word in text.split())
    except ValueError:
        numbers = ()
    return numbers if len(numbers) == 3 else (1.0, 1.0, 1.0)


def _scopes(element: Element) -> list[str]:
    """Return what may be in front of a name: the models around it, those nearest first."""
    models = [it.get("name") or "" for it in ancestry(element) if it.tag == "model"]
    inner = list(reversed(models))[1:]
    return ["".join(f"{name}::" for name in inner[:end]) for end in range(len(inner), -1, -1)]


def _others(parts: Sequence[RobotPart]) -> str:
    """Return which further parts an element of a macro makes."""
    if len(parts) < 2:
        return ""
    called = list(dict.fromkeys(it.part.name.value for it in parts[1:]))
    return f"The same element also makes {count(len(called), 'other')}: {names(called)}."
