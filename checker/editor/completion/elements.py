"""Elements, attributes and values that the schema of SDF and the tables of URDF know."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from checker.convert.gazebo_tags import short_tags
from checker.editor.completion.item import Completion, CompletionKind, Request
from checker.editor.completion.snippet import escaped, plain_element, sdf_element, writable_default
from checker.editor.meanings import (
    meaning_of,
    urdf_attributes,
    urdf_children,
    words_of_sdf,
    words_of_urdf,
)
from checker.editor.schema import schema_type
from checker.editor.xml_context import tags_behind
from checker.formats.sdf.schema import ElementType
from checker.model.sensing.kind import frame_ids, sensor_type

_ONCE = ("0", "1")
_OLD = "-1"
_SEVERAL = ("visual", "collision")
"""Elements that a link of URDF may have several times."""
_ROOTS = {".sdf": "sdf", ".world": "sdf", ".urdf": "robot", ".xacro": "robot"}


def elements(request: Request) -> Iterator[Completion]:
    """Yield the elements that may be at the caret."""
    if not request.xml.tags:
        yield from _roots(request)
    elif request.enclosing_place.path == "gazebo":
        yield from _of_gazebo(request)
    elif request.enclosing_place.language == "sdf":
        yield from _of_sdf(request, request.enclosing_place.tags)
    elif request.enclosing_place.language == "urdf":
        yield from _of_urdf(request)


def _roots(request: Request) -> Iterator[Completion]:
    suffix = next((it for it in _ROOTS if request.path.lower().endswith(it)), "")
    if suffix and _ROOTS[suffix] == "sdf":
        version = escaped(request.version)
        yield request.element("sdf", f'sdf version="${{1:{version}}}">\n  $0\n</sdf>')
    elif suffix:
        ns = ' xmlns:xacro="http://www.ros.org/wiki/xacro"' if suffix == ".xacro" else ""
        yield request.element("robot", f'robot name="$1"{ns}>\n  $0\n</robot>')


def _present(request: Request) -> set[str]:
    innermost = request.xml.innermost
    before = innermost.children if innermost is not None else ()
    return {*before, *tags_behind(request.text, request.xml.end)}


def _of_gazebo(request: Request) -> Iterator[Completion]:
    """Yield what a `<gazebo>` tag of URDF may contain: SDF, and short names for inner elements."""
    around = ("sdf", "model", "link") if request.refers else ("sdf", "model")
    yield from _of_sdf(request, around)
    shorts = {**short_tags("joint"), **short_tags("link"), "material": ()} if request.refers else {}
    for tag, path in shorts.items():
        words = meaning_of("sdf", path).words if path else ""
        detail = "/".join(path)
        yield request.element(tag, f"{tag}>$1</{tag}>", detail=detail, documentation=words)


def _of_sdf(request: Request, around: Sequence[str]) -> Iterator[Completion]:
    kind = schema_type(around, request.version)
    if kind is None or kind.free:
        return
    present = _present(request)
    meant = _part_of_sensor(request)
    if kind.name == "sensor":
        yield from _frame_ids(request)
    for tag, child in kind.children.items():
        if tag in present and child.occurs in _ONCE:
            continue
        meaning = meaning_of("sdf", (*around, tag))
        if child.occurs == _OLD:
            rank = 9
        elif tag == meant or (child.occurs in ("1", "+") and tag not in present):
            rank = 0
        else:
            rank = 4 if meaning.words else 6
        detail = " ".join(filter(None, (child.value_type, meaning.unit)))
        text = meaning.words + (f"\n\nDefault: `{child.default}`" if child.default else "")
        yield request.element(tag, sdf_element(child), detail=detail, documentation=text, rank=rank)


def _frame_ids(request: Request) -> Iterator[Completion]:
    """Yield the elements of a sensor that name the frame of its messages, those that are read."""
    known = frame_ids(request.target.release)
    for rank, tag in enumerate(known.read if known is not None else ()):
        words = meaning_of("sdf", (*request.enclosing_place.tags, tag)).words
        snippet = f"{tag}>$1</{tag}>"
        yield request.element(tag, snippet, documentation=words, rank=min(5 + rank, 9))


def _part_of_sensor(request: Request) -> str:
    """Return the element that the type of the sensor around the caret needs."""
    innermost = request.xml.innermost
    if innermost is None or innermost.tag != "sensor":
        return ""
    kind = sensor_type(innermost.attributes.get("type", ""))
    if kind.takes_pictures:
        return "camera"
    if kind.is_lidar:
        return "ray" if "ray" in innermost.attributes.get("type", "") else "lidar"
    return kind.value


def _of_urdf(request: Request) -> Iterator[Completion]:
    path, present = request.enclosing_place.path, _present(request)
    prefix = "" if path == "robot" else f"{path}/"
    for number, tag in enumerate(urdf_children(path)):
        below = prefix + tag
        if tag in present and path != "robot" and tag not in _SEVERAL and path.startswith(_READ):
            continue
        stated = [(name, "") for name, spec in urdf_attributes(below).items() if spec.required] or [
            (name, "") for name in urdf_attributes(below) if name in ("name", "link", "joint")
        ]
        holds = bool(urdf_children(below)) or tag in ("gazebo", "ros2_control")
        meaning = meaning_of("urdf", below.split("/"))
        snippet = plain_element(tag, stated, holds=holds)
        yield request.element(tag, snippet, documentation=meaning.words, rank=min(number, 8))


_READ = ("link", "joint")
"""Parts in which urdfdom reads one element of each tag."""


def attributes(request: Request) -> Iterator[Completion]:
    """Yield the attributes that may be at the caret."""
    place = request.own_place
    if place.language == "sdf":
        kind = schema_type(place.tags, request.version)
        known = {} if kind is None else kind.attributes
        for name, (value_type, default, needed) in known.items():
            written = writable_default(default)
            yield from _attribute(request, name, written, value_type, is_needed=needed == "1")
    elif place.language == "urdf":
        for name, spec in urdf_attributes(place.path).items():
            detail = f"{spec.numbers} numbers" if spec.numbers > 1 else "number" * spec.numbers
            yield from _attribute(request, name, "", detail, is_needed=spec.required)


def _attribute(
    request: Request, name: str, default: str, detail: str, *, is_needed: bool
) -> Iterator[Completion]:
    """Yield an attribute that is not there yet."""
    if name not in request.xml.attributes:
        words = meaning_of(
            request.own_place.language, request.own_place.tags or ("robot",), name
        ).words
        rank = 0 if is_needed else 5
        yield request.attribute(name, default, detail, words, rank)


def values(request: Request) -> Iterator[Completion]:
    """Yield the words that the schema knows for the attribute or text at the caret."""
    place, name = request.own_place, request.xml.attribute
    words: list[str] = []
    default = ""
    if place.language == "sdf" and (kind := schema_type(place.tags, request.version)) is not None:
        value_type, default = _type_of(kind, name)
        words = words_of_sdf(place.tags, name, value_type, request.target)
    elif place.language == "urdf" and name:
        words = words_of_urdf(place.path, name)
    for word in words:
        detail = "default" if word == default else ""
        yield request.item(word, CompletionKind.VALUE, detail=detail, rank=2)
    if default and default not in words:
        yield request.item(default, CompletionKind.VALUE, detail="default", rank=3)


def _type_of(kind: ElementType, attribute: str) -> tuple[str, str]:
    """Return the type and the default of an element's text, or of an attribute."""
    if not attribute:
        return kind.value_type, writable_default(kind.default or "")
    value_type, default, _ = kind.attributes.get(attribute, ("", "", ""))
    return value_type, writable_default(default)


def closing(request: Request) -> Iterator[Completion]:
    """Yield the elements that an end tag may close, the innermost first."""
    following = request.text[request.xml.end : request.xml.end + 1]
    for depth, element in enumerate(reversed(request.xml.around[-9:])):
        insert = element.tag if following == ">" else f"{element.tag}>"
        yield request.item(element.tag, CompletionKind.ELEMENT, insert=insert, rank=depth)
