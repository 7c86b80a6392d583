"""Hover text of an element or attribute, from the tables of SDF and URDF."""

from __future__ import annotations

import math
from collections.abc import Iterator

from checker.editor.card import card, code, names
from checker.editor.figures import number
from checker.editor.language import Place
from checker.editor.meanings import (
    Meaning,
    meaning_of,
    urdf_attributes,
    urdf_children,
    words_of_sdf,
    words_of_urdf,
)
from checker.editor.schema import schema_type
from checker.formats.sdf.schema import NO_DEFAULT, ElementType
from checker.rule import Context

_OCCURS = {"0": "at most once", "1": "once", "*": "any number", "+": "at least once"}


def element_card(
    written: str, place: Place, attribute: str, version: str, target: Context
) -> str | None:
    """Return what the tables state about an element or an attribute, as Markdown; None for nothing.

    Args:
        written: The tag as the file has it.
        place: The place of the element.
        attribute: Its name; empty for the element.
        version: SDF version.
        target: What the package is written for.
    """
    if not place.language:
        return None
    meaning = meaning_of(place.language, place.tags or ("robot",), attribute)
    if place.language == "urdf":
        rows = [*_urdf_rows(place, attribute)]
    else:
        kind = schema_type(place.tags, version)
        rows = [] if kind is None else [*_sdf_rows(kind, place, attribute, target)]
    if not any(text for _, text in rows) and meaning == Meaning():
        return None
    shown = code(f"<{written}>")
    title = f"**attribute** {code(attribute)} of {shown}" if attribute else shown
    if written != (place.tags or ("robot",))[-1]:
        rows.insert(0, ("stands for", code("/".join(place.tags[2:]))))
    text = title + (f": {meaning.words}" if meaning.words else "")
    return card(text, [("unit", meaning.unit), *rows])


def _sdf_rows(
    kind: ElementType, place: Place, attribute: str, target: Context
) -> Iterator[tuple[str, str]]:
    if attribute:
        value_type, default, required = kind.attributes.get(attribute, ["", "", ""])
        if not value_type:
            yield "note", f"SDF {kind.version} does not have it"
            return
        yield "type", code(value_type)
        yield "default", "" if default in (NO_DEFAULT, "") else code(default)
        yield "required", "yes" if required == "1" else ""
    else:
        yield "type", code(kind.value_type) if kind.value_type else ""
        yield "default", code(kind.default) if kind.default else ""
        yield "occurs", _OCCURS.get(kind.occurs, "no longer used")
        yield "allowed", _bounds(*kind.bounds)
        yield "attributes", names([*kind.attributes])
        yield "holds", names([*kind.children]) if kind.children else ""
    value_type = kind.value_type if not attribute else kind.attributes[attribute][0]
    yield "one of", names(words_of_sdf(place.tags, attribute, value_type, target))
    yield "SDF version", kind.version


def _bounds(low: float, high: float) -> str:
    if math.isinf(low) and math.isinf(high):
        return ""
    if math.isinf(high):
        return f"at least {number(low)}"
    return f"at most {number(high)}" if math.isinf(low) else f"{number(low)} to {number(high)}"


def _urdf_rows(place: Place, attribute: str) -> Iterator[tuple[str, str]]:
    attributes = urdf_attributes(place.path)
    if not attribute:
        yield "attributes", names([*attributes])
        yield "holds", names(urdf_children(place.path))
        return
    spec = attributes.get(attribute)
    if spec is None:
        return
    yield "type", f"{spec.numbers} numbers" if spec.numbers > 1 else "number" * spec.numbers
    yield "required", "yes" if spec.required else ""
    yield "since", f"URDF {spec.since}" if spec.since != "1.0" else ""
    yield "one of", names(words_of_urdf(place.path, attribute))
