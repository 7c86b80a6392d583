"""A symbol: what an outline of a file shows as one entry."""

from __future__ import annotations

from enum import StrEnum

from checker.base.record import Record
from checker.source.xml import Element


class SymbolKind(StrEnum):
    """Kind of a symbol."""

    ROBOT = "robot"
    WORLD = "world"
    MODEL = "model"
    LINK = "link"
    JOINT = "joint"
    FRAME = "frame"
    SENSOR = "sensor"
    PLUGIN = "plugin"
    INCLUDE = "include"
    MACRO = "macro"
    PROPERTY = "property"
    ARGUMENT = "argument"
    NODE = "node"
    KEY = "key"
    FUNCTION = "function"
    CLASS = "class"


class Symbol(Record):
    """An entry of an outline.

    The symbols within a link are in the order in which the robot is built; in the file, they may
    are outside it.

    Attributes:
        name: The name as it is written.
        kind: What it is.
        start: Offset of its first character.
        end: Offset behind its last one.
        name_start: Offset of its name, or of what represents it.
        name_end: Offset behind its name.
        children: Symbols within.
        detail: More of it in few words, such as the type of a joint.
    """

    name: str
    kind: SymbolKind
    start: int
    end: int
    name_start: int
    name_end: int
    children: tuple[Symbol, ...] = ()
    detail: str = ""


def element_symbol(
    element: Element,
    kind: SymbolKind,
    children: tuple[Symbol, ...] = (),
    detail: str = "",
    attribute: str = "name",
) -> Symbol:
    """Return the symbol of an XML element, which has the name in an attribute, else its tag."""
    name = element.attribute(attribute)
    shown = name.value.strip() if name is not None else ""
    place = name.span if name is not None and shown else element.name_span
    whole = element.whole_span
    shown = shown or element.tag
    return Symbol(shown, kind, whole.start, whole.end, place.start, place.end, children, detail)
