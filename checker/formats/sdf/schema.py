"""The SDFormat schema: which element may be where, with which attributes.

The tables are described in `checker/data/README.md`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import cache, cached_property
from typing import Any

from checker.base.record import Record
from checker.base.resources import table
from checker.source.xml import Element

NO_DEFAULT = "__default__"
"""Mark in the tables for a value without default, which the file has to state."""
VERSIONS = ("1.4", "1.5", "1.6", "1.7", "1.8", "1.9", "1.10", "1.11", "1.12")


class ElementType(Record, dict=True):
    """Specification of one element at one place.

    Attributes:
        name: The tag.
        description: The table's entry.
        version: SDF version.
        enclosing: Entries around this one, outermost first.
        occurs: `0` optional, `1` once, `*` any number, `+` at least once, `-1` out of use.
    """

    name: str
    description: dict[str, Any]
    version: str
    enclosing: tuple[dict[str, Any], ...] = ()
    occurs: str = "1"

    @property
    def free(self) -> bool:
        """True if any element is allowed inside (plugins)."""
        return bool(self.description.get("free"))

    @cached_property
    def attributes(self) -> Mapping[str, list[str]]:
        """Attribute name → type, default, required (`1`) or not."""
        return dict(self.description.get("attrs", {}))

    @cached_property
    def value_type(self) -> str:
        """Type of the text inside (`double`, `pose`, …); empty if there must be none."""
        return str(self.description.get("type", ""))

    @property
    def default(self) -> str | None:
        """Value that counts if the element is missing; None if the table has no default."""
        default = self.description.get("default")
        return None if default in (None, NO_DEFAULT) else str(default)

    @property
    def bounds(self) -> tuple[float, float]:
        """Smallest and largest number that may be inside."""
        least, most = self.description.get("min"), self.description.get("max")
        # The table has one limit for both numbers of a plane's size.
        low = float(least.split()[0]) if least is not None else -math.inf
        return low, float(most.split()[0]) if most is not None else math.inf

    @cached_property
    def children(self) -> dict[str, ElementType]:
        """Elements that may be directly inside, by tag."""
        children = {child.name: child for child in self._children()}
        if not self.enclosing and (world := children.get("world")) is not None:
            # No description says so, but libsdformat takes a model that is included at the top.
            children["include"] = world.children["include"]
        return children

    @cached_property
    def required_children(self) -> tuple[ElementType, ...]:
        """Those of `children` that have to be there."""
        return tuple(child for child in self.children.values() if child.occurs in ("1", "+"))

    def _children(self) -> Iterator[ElementType]:
        types = _types(self.version)
        around = (*self.enclosing, self.description)
        for kid in self.description.get("kids", ()):
            description, enclosing = kid, around
            if "ref" in kid:
                description = types[kid["ref"]]
            elif "self" in kid:
                # The enclosing element again, with what stood around it the first time.
                description = types[kid["self"]]
                enclosing = around[: next(i for i, d in enumerate(around) if d is description)]
            occurs = kid.get("req", "0")
            yield ElementType(description["name"], description, self.version, enclosing, occurs)


def known_version(version: str) -> str:
    """Return the version to judge by: that of 1.6 for a version that is not known."""
    return version if version in VERSIONS else "1.6"


def _types(version: str) -> dict[str, Any]:
    types: dict[str, Any] = table(f"sdf_spec_{known_version(version)}")["types"]
    return types


@cache
def sdf_root(version: str) -> ElementType:
    """Return the type of `<sdf>` in a version; that of 1.6 for a version that is not known."""
    known = known_version(version)
    root = table(f"sdf_spec_{known}")["root"]
    return ElementType("sdf", _types(known)[root], known)


@cache
def all_tags(version: str) -> frozenset[str]:
    """Return every tag that occurs anywhere in a version."""
    tags: set[str] = set()
    stack: list[Any] = [*_types(version).values()]
    while stack:
        entry = stack.pop()
        if "name" in entry:
            tags.add(entry["name"])
        stack.extend(entry.get("kids", ()))
    return frozenset(tags)


@cache
def parents_of(version: str) -> Mapping[str, tuple[str, ...]]:
    """Return, for each tag, the tags directly below which it may be, sorted."""
    parents: dict[str, set[str]] = {}
    for _, parent, tag in _triples(version):
        parents.setdefault(tag, set()).add(parent)
    return {tag: tuple(sorted(names)) for tag, names in parents.items()}


@cache
def holders_of(version: str, parent: str, tag: str) -> tuple[str, ...]:
    """Return the tags below which a `parent` may contain a `tag`, sorted: `kp` in `contact/ode`."""
    return tuple(sorted({top for top, *rest in _triples(version) if rest == [parent, tag] and top}))


@cache
def _triples(version: str) -> frozenset[tuple[str, str, str]]:
    """Return grandparent, parent and child tags; the first is empty for any."""
    types = _types(version)
    triples: set[tuple[str, str, str]] = set()
    stack: list[tuple[str, Any]] = [("", entry) for entry in types.values()]
    while stack:
        top, entry = stack.pop()
        for kid in entry.get("kids", ()):
            kind = kid.get("ref") or kid.get("self")
            tag = types[kind]["name"] if kind else kid["name"]
            triples.add((top, entry["name"], tag))
            if not kind:
                stack.append((entry["name"], kid))
    return frozenset(triples)


def type_of(element: Element, version: str) -> ElementType | None:
    """Return the type of an element in a version, by what it is in; None without a place."""
    above: list[Element] = []
    at: Element | None = element
    while at is not None:
        above.append(at)
        at = at.parent
    kind = sdf_root(version) if above.pop().tag == "sdf" else None
    while above and kind is not None and not kind.free:
        kind = kind.children.get(above.pop().tag)
    return kind


def walk(
    root: Element, version: str, reads: str = ""
) -> Iterator[tuple[Element, ElementType | None]]:
    """Yield each element with its type, in document order; None for one that has no place there.

    The version that the file is read as, `reads`, gives the type where its own does not know one.
    What is below an unknown or a free element is ignored, and so are elements with a
    namespace prefix, which SDFormat leaves to others.
    """
    is_sdf = root.tag == "sdf"
    own = sdf_root(version) if is_sdf else None
    later = sdf_root(reads) if is_sdf and reads else None
    stack: list[tuple[Element, ElementType | None, ElementType | None]] = [(root, own, later)]
    while stack:
        element, own, later = stack.pop()
        kind = own if own is not None else later
        yield element, kind
        if kind is None or kind.free:
            continue
        stack.extend(
            (child, _child(own, child.tag), _child(later, child.tag))
            for child in reversed(element.children)
            if ":" not in child.tag
        )


def _child(kind: ElementType | None, tag: str) -> ElementType | None:
    return kind.children.get(tag) if kind is not None and not kind.free else None
