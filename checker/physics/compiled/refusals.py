"""What a refusal of MuJoCo is about: the element and attribute, the name that is meant, the fix."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from checker.base.record import Record
from checker.base.resources import table
from checker.base.words import Suggestions
from checker.finding import Fix, Safety
from checker.formats.mjcf.model import MjcfModel
from checker.physics.compiled.model import CompiledModel, Refusal
from checker.rule import replace_text, respelling
from checker.source.text import Located, Span
from checker.source.xml import Element

_UNKNOWN_ATTRIBUTE = re.compile(r"unrecognized attribute: '([^']*)'")
_OF_KEY = re.compile(r"^Error: (?:keyframe|invalid q)")
_TAIL = re.compile(r"\n?Element (?:name )?'.*", re.DOTALL)
_HEAD = re.compile(r"^(?:XML )?Error: (?:Schema \w+: )?")
_ID = re.compile(r"\bid (?:= ?)?(\d+)")
_QUOTED = re.compile(r"'([^']+)'")
_ORDER = "fullinertia is in the order ixx iyy izz ixy ixz iyz, which is not that of URDF"
_TAGS: Mapping[str, tuple[str, ...]] = {
    "joint": ("joint", "freejoint"),
    "jointinparent": ("joint",),
    "joint1": ("joint",),
    "joint2": ("joint",),
    "body1": ("body",),
    "body2": ("body",),
    "geom1": ("geom",),
    "geom2": ("geom",),
    "tendon": ("spatial", "fixed"),
    "class": ("default",),
    "childclass": ("default",),
    **{it: (it,) for it in ("site", "body", "geom", "material", "mesh", "texture", "hfield")},
}
"""Elements whose names an attribute may state."""


class Explained(Record, eq=False):
    """A refusal in words, the place of what it is about, and the fix where one is sure."""

    message: str
    span: Span
    fix: Fix | None = None


def explained(model: CompiledModel, refusal: Refusal) -> Explained:
    """Return what a refusal is about."""
    text = " ".join(_HEAD.sub("", _TAIL.sub("", refusal.text)).split())
    element = _element(model, refusal)
    if element is None:
        return Explained(text, model.model.document.root.span)
    message = f"{text} in <{element.tag}>"
    if unknown := _UNKNOWN_ATTRIBUTE.search(refusal.text):
        return _of_attribute(message, element, unknown[1])
    for name in _QUOTED.findall(text):
        for attribute, tags in _TAGS.items():
            if element.get(attribute) == name and (value := element.attribute(attribute)):
                known = Suggestions(_names(model.model, tags))
                return Explained(message + known.hint(name), value.span, respelling(value, known))
    known_tags = table("mjcf_names")["elements"]
    if element.tag not in known_tags:
        message += Suggestions(known_tags).hint(element.tag)
    elif element.get("fullinertia") and "inertia" in text:
        message += f"; {_ORDER}"
    return Explained(message, element.span)


def _element(model: CompiledModel, refusal: Refusal) -> Element | None:
    if refusal.line or not _OF_KEY.search(refusal.text):
        element = model.element(refusal.line)
        # MuJoCo names the body of an <inertial>.
        inertial = element.child("inertial") if element and "inertia" in refusal.text else None
        return inertial or element
    # MuJoCo knows no line of a keyframe.
    number = _ID.search(refusal.text)
    keys = [*model.model.tagged("key")]
    at = int(number[1]) if number else 0
    return keys[at] if at < len(keys) else None


def _of_attribute(message: str, element: Element, name: str) -> Explained:
    names: Mapping[str, Any] = table("mjcf_names")
    if name not in element.attributes:
        return Explained(message, element.span)
    span = element.attribute_name_span(name)
    if cure := names["removed"].get(name):
        whole = element.whole_attribute_span(name)
        fix = replace_text(whole, "", Safety.UNSAFE) if cure.endswith("delete it") else None
        return Explained(f"{message}, {cure}", span, fix)
    known = Suggestions(names["elements"].get(element.tag, ()))
    return Explained(message + known.hint(name), span, respelling(Located(name, span), known))


def _names(model: MjcfModel, tags: tuple[str, ...]) -> list[str]:
    attribute = "class" if tags == ("default",) else "name"
    return [name for element in model.tagged(*tags) if (name := element.get(attribute))]
