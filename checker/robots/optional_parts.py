"""Files that hold a part of a robot, such as a sensor, and that no robot includes at present.

Such a file needs macros or properties of what the robot includes before it, so it does not expand
alone.
"""

from __future__ import annotations

from checker.formats.xacro.fault import XacroFault, XacroFaultKind
from checker.formats.xacro.macro_names import macro_names
from checker.package.package import Package
from checker.source.text import SourceText
from checker.source.xml import XmlDocument

_UNKNOWN = "unknown macro name: xacro:"


def is_optional_part(package: Package, path: str, fault: XacroFault) -> bool:
    """Return whether a file that does not expand lacks a part of another one, and no more.

    Without links it cannot be a robot. Else it lacks a macro of another file, a joint connects each
    of its links, and one leads to a link of another file: a robot has a root.

    Args:
        package: The package of the file.
        path: The file, which no file includes and no launch file loads.
        fault: Why it does not expand.
    """
    macro = fault.message.removeprefix(_UNKNOWN)
    if fault.kind is not XacroFaultKind.EXPANSION:
        return False
    if macro == fault.message:
        return _has_no_link(package, path)
    return _needs_a_parent(package, path) and macro in _macros_beside(package, path)


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


def _macros_beside(package: Package, path: str) -> frozenset[str]:
    files = (it.path for it in package.index.with_suffix(".xacro", ".urdf") if it.path != path)
    sources = (package.read(file) for file in files)
    return macro_names(source.text for source in sources if isinstance(source, SourceText))
