"""Packages of a released repository that was copied beside the user's own packages."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.package.files_above import files_above
from checker.package.mentions import has_word
from checker.package.released import distributions_with
from checker.source.text import SourceText

if TYPE_CHECKING:
    from checker.package.package import Package

_LICENCE = re.compile(r"\A\.\./(?:licen[cs]e|copying)(?:\.\w{1,8})?\Z")
_NAMING = (".py", ".xml", ".launch", ".xacro", ".urdf", ".sdf", ".world", ".yaml", ".yml")


def vendored_in(package: Package) -> str:
    """Return the folder of the copied repository that a package is in; empty for the user's own.

    The folder has a licence and is not the one that the user gave, a ROS distribution has the
    package, and there are packages outside that none has: those of the user. Nothing in these names
    the package, package.xml aside.

    Args:
        package: The package being checked.
    """
    folder, given = package.root.parent, package.workspace.given
    if package.only or given is None or folder == given:
        return ""
    if not any(files_above(package, _LICENCE)[:1]) or not distributions_with(package.declared_name):
        return ""
    own = [it for it in package.workspace.packages.values() if _is_own(it, package)]
    named = (has_word(text, package.declared_name) for it in own for text in _texts(it))
    return folder.name if own and not any(named) else ""


def _is_own(other: Package, package: Package) -> bool:
    outside = not other.root.is_relative_to(package.root.parent)
    return outside and not distributions_with(other.declared_name)


def _texts(package: Package) -> Iterator[str]:
    for entry in package.index.with_suffix(*_NAMING):
        source = package.read(entry.path) if entry.path != "package.xml" else None
        if isinstance(source, SourceText):
            yield source.text
