"""Packages of the controllers and the hardware that a package names: pluginlib loads them."""

from __future__ import annotations

import re
from collections.abc import Iterator

from checker.package.dependencies import Use
from checker.package.package import Package
from checker.ros.ros2_control.distributions import controller_types, hardware_classes, is_mock
from checker.source.text import SourceText, Span
from checker.source.xml import XmlDocument

_TYPE = re.compile(r"""^\s{1,40}type:[ \t]{1,8}["']?([a-z]\w{0,99}/[A-Z]\w{0,99})\b""", re.M)


def plugin_uses(package: Package) -> Iterator[Use]:
    """Yield the packages of known controllers in parameter files, and of hardware in robots."""
    for file in package.index.with_suffix(".yaml", ".yml"):
        source = package.read(file.path)
        if not isinstance(source, SourceText):
            continue
        for match in _TYPE.finditer(source.text):
            if (kind := controller_types().get(match[1])) is not None:
                place = Span(source, *match.span(1)).place()
                yield Use(kind.package, place, f"controller {match[1]}")
    for file in package.index.with_suffix(".urdf", ".xacro"):
        document = package.xml(file.path)
        for element in document.elements if isinstance(document, XmlDocument) else ():
            known = hardware_classes().get(element.value) if element.tag == "plugin" else None
            if known is not None and not is_mock(known.name):
                yield Use(known.package, element.text.span.place(), f"hardware {known.name}")
