"""Versions, elements and attributes of URDF, as the table `urdf_spec.json` has them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import cache

import msgspec

from checker.base.record import Record
from checker.base.resources import table
from checker.base.words import Suggestions
from checker.finding import Edit
from checker.formats.urdf.extensions import OF_JOINTS, OF_LINKS
from checker.model.values import parse_number
from checker.source.text import Located, Span
from checker.source.xml import Element, XmlDocument

FIRST = "1.0"
_GEOMETRIES = ("link/visual/geometry", "link/collision/geometry")
_SEVERAL = ("visual", "collision")
_WITHOUT_AXIS = ("fixed", "floating")


class AttributeSpec(Record):
    """Specification of an attribute.

    Attributes:
        numbers: The count of numbers; 0 for a text.
        required: Whether urdfdom needs it.
        since: The version of URDF that brought it.
    """

    numbers: int = 0
    required: bool = False
    since: str = FIRST


class NewerPart(Record):
    """An element or attribute that the file's version does not have."""

    name: str
    since: str
    span: Span


class StrayPart(Record):
    """An element below a link or joint, where no reader looks for it.

    Attributes:
        element: The element.
        path: The path of the tag around it.
        owner: The link or joint.
        advice: What to write instead.
    """

    element: Element
    path: str
    owner: Element
    advice: str


class MisspeltPart(Record):
    """An element or attribute that no reader looks at, and that resembles one that they read.

    Attributes:
        name: The name as written.
        around: The element around it.
        meant: What it resembles, which is not there.
        span: Its place.
        path: The path of the tag around it.
        edits: What writes the other name; none where it is not sure.
        is_zero: Whether it is an attribute of zeros, which counts without it too.
    """

    name: str
    around: Element
    meant: str
    span: Span
    path: str
    edits: tuple[Edit, ...] = ()
    is_zero: bool = False


@cache
def _elements() -> Mapping[str, Mapping[str, AttributeSpec]]:
    return {
        path: {name: msgspec.convert(entry, AttributeSpec) for name, entry in attributes.items()}
        for path, attributes in table("urdf_spec")["elements"].items()
    }


def version_of(document: XmlDocument) -> Located[str]:
    """Return the version that a file states; 1.0 without one."""
    root = document.root
    return root.attribute("version") or Located(FIRST, root.span, stated=False)


def has_version(document: XmlDocument, least: str) -> bool:
    """Return whether a file has what a version brought; False for an unknown version."""
    versions = list(table("urdf_spec")["versions"])
    stated = version_of(document).value
    return stated in versions and versions.index(stated) >= versions.index(least)


def specified_elements(
    document: XmlDocument,
) -> Iterator[tuple[Element, Mapping[str, AttributeSpec]]]:
    """Yield the elements of links and joints with the values of their attributes, in order."""
    for element, path in _descendants(document):
        around = element.parent.get("type") if element.parent is not None else ""
        if path in _elements() and not (path == "joint/axis" and around in _WITHOUT_AXIS):
            yield element, _elements()[path]


def lacking_elements(document: XmlDocument) -> Iterator[tuple[Element, str]]:
    """Yield elements without one that they need, with what it would be."""
    spec = table("urdf_spec")
    shapes = spec["shapes"]
    for element, path in _descendants(document):
        for tag in spec["needs"].get(path, ()):
            if element.child(tag) is None:
                yield element, f"<{tag}>"
        if path in _GEOMETRIES and not any(child.tag in shapes for child in element.children[:1]):
            yield element, f"shape: expected <{'>, <'.join(shapes)}>"


def newer_parts(document: XmlDocument) -> Iterator[NewerPart]:
    """Yield elements and attributes that came with a later version than the file states."""
    parts = table("urdf_spec")["parts"]
    for element, path in _descendants(document):
        if path in parts and not has_version(document, parts[path]):
            yield NewerPart(f"<{element.tag}>", parts[path], element.span)
        for name, spec in _elements().get(path, {}).items():
            stated = element.attribute(name)
            if stated is not None and not has_version(document, spec.since):
                yield NewerPart(name, spec.since, stated.span)


def misspelt_parts(document: XmlDocument) -> Iterator[MisspeltPart]:
    """Yield elements and attributes whose names are near those of something that is missing."""
    for element, path in _descendants(document):
        there = {child.tag for child in element.children}
        for child in element.children:
            known = _children().get(path, frozenset())
            if child.tag not in known and (meant := Suggestions(known - there).closest(child.tag)):
                names = [child.name_span, child.end_name_span]
                edits = tuple(name.replacement(meant) for name in names if name is not None)
                name, right = f"<{child.tag}>", f"<{meant}>"
                yield MisspeltPart(name, element, right, child.span, path, edits)
        spec = _elements().get(path, {})
        # What is required and missing is reported as such.
        lost = [key for key, it in spec.items() if not it.required and element.get(key) is None]
        for name in element.attributes if lost else ():
            text = element.attribute(name)
            meant = _suggestion(name, lost) if name not in spec else None
            if text is not None and meant is not None:
                edits = (element.attribute_name_span(name).replacement(meant),)
                zero = element.tag == "origin" and _are_zeros(text.value)
                yield MisspeltPart(name, element, meant, text.span, path, edits, zero)


def stray_parts(document: XmlDocument) -> Iterator[StrayPart]:
    """Yield elements of `<robot>`, `<gazebo>` and SDF that are written in links and joints.

    Also plugins that are in `<robot>` itself.
    """
    root = document.root
    for plugin in root.all("plugin"):
        yield StrayPart(plugin, root.tag, root, table("urdf_spec")["elsewhere"]["other"]["plugin"])
    for element, path in _descendants(document):
        if "/" not in path:
            owner = element
        known = _children().get(path, frozenset())
        for child in element.children if known else ():
            advice = None if child.tag in known else _advice(child, path, owner)
            if advice is not None and not _changes_nothing(child):
                yield StrayPart(child, path, owner, advice)
        if path in _GEOMETRIES:
            yield from _further_shapes(element, path, owner)


def _further_shapes(geometry: Element, path: str, owner: Element) -> Iterator[StrayPart]:
    """Yield the shapes behind the first one, which urdfdom reads alone."""
    order: list[str] = table("urdf_spec")["shapes_of_mujoco"]
    shapes = [child for child in geometry.children if child.tag in order]
    for shape in shapes[1:]:
        first, own = shapes[0].tag, path.split("/")[1]
        other = min((it.tag for it in shapes), key=order.index)
        mujoco = f" (MuJoCo: <{other}>)" if other != first else ""
        advice = f"they take the first shape, <{first}>{mujoco}; write a <{own}> for each shape"
        yield StrayPart(shape, path, owner, advice)


def _changes_nothing(part: Element) -> bool:
    """Return whether an element has the same effect as without it."""
    if part.tag == "origin":
        return _are_zeros(f"{part.get('xyz') or ''} {part.get('rpy') or ''}")
    if part.tag == "joint_properties":
        return _are_zeros(f"{part.get('damping') or ''} {part.get('friction') or ''}")
    return part.text.value.strip() in table("urdf_spec")["elsewhere"]["defaults"].get(part.tag, ())


def _without_origin(part: Element, link: Element) -> str:
    """Return the tag right before a part of a link, of one that may have an origin and has none."""
    before = link.children[link.children.index(part) - 1] if link.children[0] is not part else None
    placed = before is not None and before.tag in (*_SEVERAL, "inertial")
    return before.tag if before and placed and before.child("origin") is None else ""


def _are_zeros(text: str) -> bool:
    return all(parse_number(number) == 0 for number in text.split())


def _advice(part: Element, path: str, owner: Element) -> str | None:
    """Return what to write instead of an element that readers ignore; None if it is unknown."""
    if path == "link" and part.tag == "origin" and (before := _without_origin(part, owner)):
        return f"move it into the <{before}> before it, if it is to place that"
    elsewhere = table("urdf_spec")["elsewhere"]
    other: Mapping[str, str] = elsewhere["other"]
    if text := other.get(f"{path}/{part.tag}") or other.get(part.tag):
        return text
    name = owner.get("name") or "…"
    if part.tag in elsewhere["robot"]:
        lacks = part.tag == "gazebo" and part.get("reference") is None
        return "move it into <robot>" + (f' and add reference="{name}"' if lacks else "")
    if part.tag == "material" or (part.tag == "sensor" and part.get("type") is None):
        return None  # a colour of a collision; a sensor of another program
    known = OF_JOINTS if path == "joint" else OF_LINKS.union(elsewhere["sdf"])
    return f'move it into <gazebo reference="{name}"> in <robot>' if part.tag in known else None


def _suggestion(name: str, known: list[str]) -> str | None:
    """Return the word with the same letters, or the nearest one."""
    same = (word for word in known if sorted(word) == sorted(name))
    return next(same, None) or Suggestions(known).closest(name)


@cache
def _children() -> Mapping[str, frozenset[str]]:
    """Return the tags that readers look for, by the path of what is around them."""
    children: dict[str, set[str]] = defaultdict(set)
    for path in _elements():
        parts = path.split("/")
        for depth in range(1, len(parts)):
            children["/".join(parts[:depth])].add(parts[depth])
    children["joint"].update(("parent", "child"))
    return {path: frozenset(tags) for path, tags in children.items()}


def _descendants(document: XmlDocument) -> Iterator[tuple[Element, str]]:
    """Yield all that is in links and joints, with its path; readers look no deeper than 4."""
    waiting = [(part, part.tag) for part in document.root.children if part.tag in ("link", "joint")]
    waiting.reverse()
    while waiting:
        element, path = waiting.pop()
        yield element, path
        if path.count("/") < 3:
            waiting += [
                (child, f"{path}/{child.tag}") for child in reversed(_read_children(element))
            ]


def _read_children(parent: Element) -> list[Element]:
    """Return the children that readers look at: the first of each tag, and all shapes."""
    first = {child.tag: child for child in reversed(parent.children)}
    return [
        child for child in parent.children if child.tag in _SEVERAL or first[child.tag] is child
    ]
