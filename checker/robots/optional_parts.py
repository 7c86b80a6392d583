"""Files that hold a part of a robot, such as a sensor, and that no robot includes at present.

Such a file needs macros or properties of what the robot includes before it, so it does not expand
alone.
"""

from __future__ import annotations

import re

from checker.formats.xacro.fault import XacroFault, XacroFaultKind
from checker.formats.xacro.macro_names import macro_names
from checker.package.package import Package
from checker.source.text import SourceText, without_comments
from checker.source.xml import XmlDocument

_LACKS = re.compile(
    r"unknown macro name: xacro:([\w-]{1,100})\Z|\bname '(\w{1,100})' is not defined"
)
_PROPERTY = re.compile(
    r"""<(?:xacro:)?property\s[^>]{0,300}?\bname\s{0,8}=\s{0,8}["']([\w-]{1,100})["']"""
)


def is_optional_part(
    package: Package, path: str, fault: XacroFault, *, left_out: bool = False
) -> bool:
    """Return whether a file that does not expand lacks a part of another one, and no more.

    Without links it cannot be a robot. Else it lacks a macro or property of another file. Beside a
    robot that is loaded this is enough; else a joint connects each of its links, and one leads to a
    link of another file: a robot has a root.

    Args:
        package: The package of the file.
        path: The file, which no file includes and no launch file loads.
        fault: Why it does not expand.
        left_out: Whether nothing names the file, where launch files load another one.
    """
    if fault.kind is not XacroFaultKind.EXPANSION:
        return False
    lacks = _LACKS.search(fault.message)
    if (lacks is None or lacks[2]) and _has_no_link(package, path):
        return True
    if lacks is None or not (left_out or _needs_a_parent(package, path)):
        return False
    return (lacks[1] or lacks[2]) in _names_beside(package, path)


def _has_no_link(package: Package, path: str) -> bool:
    """Return whether a file has no links, neither in a macro nor by what it includes."""
    document = package.xml(path)
    tags = ("link", "xacro:include", "include")
    return isinstance(document, XmlDocument) and not any(
        element.tag in tags for element in document.elements
    )


def _needs_a_parent(package: Package, path: str) -> bool:
    document = package.xml(path)
    if not isinstance(document, XmlDocument):
        return False
    links = {link.get("name") for link in document.root.all("link")}
    joints = document.root.all("joint")
    children = {end.get("link") for joint in joints for end in joint.all("child")}
    parents = {end.get("link") for joint in joints for end in joint.all("parent")}
    return bool(links) and links <= children and not parents <= links


def _names_beside(package: Package, path: str) -> frozenset[str]:
    """Return the names of the macros and properties of other files."""
    files = (it.path for it in package.index.with_suffix(".xacro", ".urdf") if it.path != path)
    sources = (package.read(file) for file in files)
    found = (it for it in sources if isinstance(it, SourceText))
    texts = [without_comments(it.file, it.text) for it in found]
    return macro_names(texts).union(*map(_PROPERTY.findall, texts))
