"""Tags of xacro without the prefix `xacro:`, which only releases before ROS Noetic expand."""

from __future__ import annotations

from collections.abc import Iterator

from checker.formats.xacro.fault import XacroFault, XacroFaultKind
from checker.formats.xacro.files import Gathered, path_of
from checker.formats.xacro.macro_names import OF_URDF, macro_names
from checker.package.package import Package
from checker.source.xml import Element, XmlDocument

TAGS = ("include", "insert_block", "macro", "property")
"""Those that no reader of URDF knows; they are directly in the robot."""


def bare_tags(package: Package, path: str) -> Iterator[XacroFault]:
    """Yield a fault for each file with such tags, of a file and what it includes.

    Args:
        package: The package of the file.
        path: The path as the package lists it.
    """
    documents = _documents(package, path)
    macros = macro_names(document.source.text for document in documents)
    for document in documents:
        bare = [each for each in document.root.children if each.tag in TAGS or each.tag in macros]
        if bare:
            names = dict.fromkeys(child.tag for child in bare)
            message = " and ".join(f"<{name}>" for name in names)
            hint = "write " + " and ".join(f"<xacro:{name}>" for name in names)
            file, span = document.source.file, bare[0].span
            yield XacroFault(XacroFaultKind.PREFIX, file, span, message, hint)


def bare_calls(package: Package, path: str, expanded: XmlDocument) -> list[Element]:
    """Return the tags of xacro that are left in what a file expands to, calls of macros too."""
    unknown = [child for child in expanded.root.children if child.tag not in OF_URDF]
    calls = [child for child in unknown if child.tag not in TAGS]
    texts = (each.source.text for each in (_documents(package, path) if calls else ()))
    known = macro_names(texts).union(TAGS)
    return [child for child in unknown if child.tag in known]


def _documents(package: Package, path: str) -> tuple[XmlDocument, ...]:
    gathered = Gathered(package)
    gathered.follow([path_of(package, path)])
    return tuple(gathered.documents.values())
