"""A name that two siblings share, or that is reserved.

Plugins, bridges and joints find a part by its name; of two parts with one name only the first is
found, and newer parsers refuse the file. Names of the form `__x__`, the name `world`, and names
with `::` mean something else to the parser. Plugins may share a name.

Fix: give each sibling a name of its own.
Source: SDFormat specification 1.7, "unique sibling names" and "reserved names".
"""

import re
from collections.abc import Iterator

from checker.model.sdf.document import SdfDocument
from checker.model.sdf.reader import sdf_version
from checker.rule import Finding, Findings, Severity, finding, rule
from checker.source.xml import Element

_RESERVED = re.compile(r"__.*__")
_FRAMES = frozenset({"link", "joint", "frame", "model"})
"""Elements that are frames too, and so share one set of names."""


@rule("SDF009", "duplicate-name", Severity.ERROR)
def check(sdf: SdfDocument) -> Findings:
    """Report siblings of one name, and reserved names."""
    strict = sdf_version(sdf.document) >= (1, 7)
    for element in sdf.elements():
        yield from _twins(element, strict)
        if element.tag in _FRAMES:
            yield from _reserved(element)


def _twins(parent: Element, strict: bool) -> Iterator[Finding]:
    named: dict[tuple[str, str], Element] = {}
    frames: dict[str, Element] = {}
    for child in parent.children:
        name = child.attribute("name")
        if name is None or child.tag == "plugin" or ":" in child.tag:
            continue
        first = named.setdefault((child.tag, name.value), child)
        other = frames.setdefault(name.value, child) if child.tag in _FRAMES else child
        if first is not child:
            yield finding(
                name,
                f"<{child.tag}> {name.value!r} has the name of another <{child.tag}>",
                related=[(first.attribute("name") or first, "the first of that name")],
            )
        elif other is not child:
            yield finding(
                name,
                f"<{child.tag}> {name.value!r} has the name of a <{other.tag}>",
                severity=None if strict else Severity.WARNING,
                related=[(other.attribute("name") or other, "the first of that name")],
            )


def _reserved(element: Element) -> Iterator[Finding]:
    name = element.attribute("name")
    if name is None:
        return
    if _RESERVED.fullmatch(name.value) or name.value == "world":
        yield finding(name, f"<{element.tag}> has the reserved name {name.value!r}")
    elif "::" in name.value:
        yield finding(
            name, f"name {name.value!r} holds '::', which separates the names of nested models"
        )


GOOD = [
    """
<link name="left_wheel"/>
<link name="right_wheel"/>
<plugin name="p" filename="liba.so"/>
<plugin name="p" filename="liba.so"/>
""",
    '<link name="arm"><visual name="body"/><collision name="body"/></link>',
]
BAD = [
    """
<link name="wheel"/>
<link name="wheel"/>  <!-- ^ SDF009 -->
""",
    """
<link name="hinge"/>
<joint name="hinge" type="fixed"><parent>base_link</parent><child>hinge</child></joint>  <!-- ^ SDF009 -->
""",  # noqa: E501
    '<link name="__model__"/>  <!-- ^ SDF009 -->',
    '<link name="arm::wrist"/>  <!-- ^ SDF009 -->',
]
