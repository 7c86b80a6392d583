"""Packages of the controllers and the hardware that a package names: pluginlib loads them."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator

from checker.package.dependencies import Use
from checker.package.mentions import has_file
from checker.package.package import Package
from checker.ros.ros2_control.distributions import controller_types, hardware_classes, is_mock
from checker.ros.ros2_control.exported_hardware import exported_hardware, owner_of
from checker.source.text import SourceText, Span, without_comments
from checker.source.xml import Element, XmlDocument

_TYPE = re.compile(r"""^\s{1,40}type:[ \t]{1,8}["']?([a-z]\w{0,99}/[A-Z]\w{0,99})\b""", re.M)

_LOADING = (
    *(".launch", ".py", ".xml", ".yaml", ".yml"),
    *(".md", ".sdf", ".sh", ".urdf", ".world", ".xacro"),
)
"""Endings of files that may load a file of parameters, or say how to."""


def plugin_uses(package: Package) -> Iterator[Use]:
    """Yield the packages of known controllers in parameter files, and of hardware in robots."""
    for file in package.index.with_suffix(".yaml", ".yml"):
        source = package.read(file.path)
        if not isinstance(source, SourceText):
            continue
        known = [it for it in _TYPE.finditer(source.text) if it[1] in controller_types()]
        for match in known if known and not _is_commented_out(package, file.path) else ():
            place = Span(source, *match.span(1)).place()
            yield Use(controller_types()[match[1]].package, place, f"controller {match[1]}")
    for element in _plugins(package):
        kind = hardware_classes().get(element.value)
        if kind is not None and not is_mock(kind.name):
            yield Use(kind.package, element.text.span.place(), f"hardware {kind.name}")


def uses_beside(package: Package) -> Iterator[Use]:
    """Yield the packages of the workspace that export the hardware of robots."""
    for element in _plugins(package):
        name = element.value
        owner = package.workspace.package(owner_of(name)) if "/" in name else None
        if owner is not None and name in (exported for exported, _ in exported_hardware(owner)):
            yield Use(owner_of(name), element.text.span.place(), f"hardware {name}")


def _plugins(package: Package) -> Iterator[Element]:
    """Yield what names a plugin of ros2_control: `<transmission>` elsewhere is of ROS 1."""
    for file in package.index.with_suffix(".urdf", ".xacro"):
        document = package.xml(file.path)
        for element in document.elements if isinstance(document, XmlDocument) else ():
            around = element.parent.tag if element.parent is not None else ""
            if element.tag == "plugin" and around != "transmission":
                yield element


def _is_commented_out(package: Package, path: str) -> bool:
    """Return whether files of the workspace name a file, and only in comments."""
    name = posixpath.basename(path)
    naming = [
        source
        for each in (package, *package.other_packages)
        for file in each.index.with_suffix(*_LOADING)
        if each is not package or file.path != path
        if isinstance(source := each.read(file.path), SourceText) and has_file(source.text, name)
    ]
    return bool(naming) and not any(
        has_file(without_comments(source.file, source.text), name) for source in naming
    )
