"""Tags of xacro without the prefix `xacro:`, which only releases before ROS Noetic expand."""

from __future__ import annotations

from collections.abc import Iterator

from checker.formats.xacro.fault import XacroFault, XacroFaultKind
from checker.formats.xacro.files import Gathered, path_of
from checker.package.package import Package

TAGS = ("include", "insert_block", "macro", "property")
"""Those that no reader of URDF knows; they are directly in the robot."""


def bare_tags(package: Package, path: str) -> Iterator[XacroFault]:
    """Yield a fault for each file with such tags, of a file and what it includes.

    Args:
        package: The package of the file.
        path: The path as the package lists it.
    """
    gathered = Gathered(package)
    gathered.follow([path_of(package, path)])
    for document in gathered.documents.values():
        bare = [child for child in document.root.children if child.tag in TAGS]
        if bare:
            names = dict.fromkeys(child.tag for child in bare)
            message = " and ".join(f"<{name}>" for name in names)
            hint = "write " + " and ".join(f"<xacro:{name}>" for name in names)
            file, span = document.source.file, bare[0].span
            yield XacroFault(XacroFaultKind.PREFIX, file, span, message, hint)
