"""Which other packages a package uses: in its spawner, its launch files and its models."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.finding import Place
from checker.package.references import ReferenceKind
from checker.record import record
from checker.source.xml import Element, XmlDocument

if TYPE_CHECKING:
    from checker.package.package import Package

_FIND = re.compile(r"\$\(find\s{1,8}([A-Za-z][\w-]{0,199})\s{0,8}\)")
_MODEL = re.compile(r"(?:model|package)://([a-z][a-z0-9_]{0,199}_sensor_config_\d{1,4})/")
"""Submissions alone: other models, and those on Fuel in upper case, come from elsewhere."""


@record(slots=True)
class Use:
    """One place at which a package is used; `how` is the text that uses it."""

    package_name: str
    place: Place
    how: str


def uses_of(package: Package) -> Iterator[Use]:
    """Yield the packages that the spawner, launch files and the model name; comments do not count.

    Launch files that are not well-formed are left out.
    """
    for reference in package.references:
        if reference.kind is not ReferenceKind.DEPENDENCY:
            how = f"{reference.kind} {reference.package_name} {reference.file}".strip()
            yield Use(reference.package_name, reference.place, how)
    for file in package.index.with_suffix(".launch", ".sdf"):
        document = package.xml(file.path)
        if isinstance(document, XmlDocument):
            is_launch = file.path.lower().endswith(".launch")
            for element in document.elements:
                yield from _in_launch_file(element) if is_launch else _in_model(element)


def _in_launch_file(element: Element) -> Iterator[Use]:
    for name, value in element.attributes.items():
        for match in _FIND.finditer(value):
            yield Use(match[1], _place(element, name), match.group())
        if name == "pkg" and element.tag in ("node", "test") and "$" not in value:
            yield Use(value, _place(element, name), f"pkg={value}")
    for match in _FIND.finditer(element.value):
        yield Use(match[1], element.text.span.place(), match.group())


def _place(element: Element, attribute: str) -> Place:
    return (element.attribute(attribute) or element).span.place()


def _in_model(element: Element) -> Iterator[Use]:
    if element.tag == "uri" and (match := _MODEL.match(element.value)):
        yield Use(match[1], element.text.span.place(), match.group())
