"""Files that `.gitignore` keeps out of a repository, by the ends of their names."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.package.files_above import files_around
from checker.source.text import SourceText

if TYPE_CHECKING:
    from checker.package.package import Package

_FILE = ".gitignore"
_NAMES = re.compile(r"\A(?:\.\./)*\.gitignore\Z")
_PATTERN = re.compile(r"\*?[\w.-]{1,100}")
_KEPT = "!"


def ignored_by(package: Package, path: str) -> str:
    """Return the line of a `.gitignore` that excludes a file of this name: `.gitignore:3`.

    Lines that are a name, or its end after an asterisk (`*.pcd`), count; others are not read. A
    later line that keeps files of such a name (`!src/**/*.pcd`) may keep this one.
    """
    name = posixpath.basename(path)
    for source in (*_beside(package, path), *files_around(package, _NAMES)):
        found = ""
        for number, line in enumerate(source.text.splitlines(), 1):
            pattern = line.strip()
            if pattern.startswith(_KEPT):
                found = "" if _fits(name, posixpath.basename(pattern.lstrip(_KEPT))) else found
            elif _fits(name, pattern):
                found = f"{source.file}:{number}"
        if found:
            return found
    return ""


def _beside(package: Package, path: str) -> Iterator[SourceText]:
    """Yield those in the folders of a package that lead to a file, the nearest first."""
    folder = posixpath.dirname(posixpath.normpath(path))
    while folder and not folder.startswith((".", "/")):
        source = package.read(f"{folder}/{_FILE}")
        if isinstance(source, SourceText):
            yield source
        folder = posixpath.dirname(folder)


def _fits(name: str, pattern: str) -> bool:
    if not _PATTERN.fullmatch(pattern):
        return False
    return name == pattern or (pattern[0] == "*" and name.endswith(pattern[1:]))
