"""Files that `.gitignore` keeps out of a repository, by the ends of their names."""

from __future__ import annotations

import posixpath
import re
from typing import TYPE_CHECKING

from checker.package.files_above import files_around

if TYPE_CHECKING:
    from checker.package.package import Package

_NAMES = re.compile(r"\A(?:\.\./)*\.gitignore\Z")
_PATTERN = re.compile(r"\*?[\w.-]{1,100}")
_KEPT = "!"


def ignored_by(package: Package, path: str) -> str:
    """Return the line of a `.gitignore` that excludes a file of this name: `.gitignore:3`.

    Lines that are a name, or its end after an asterisk (`*.pcd`), count; others are not read. A
    later line that keeps files of such a name (`!src/**/*.pcd`) may keep this one.
    """
    name = posixpath.basename(path)
    for source in files_around(package, _NAMES):
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


def _fits(name: str, pattern: str) -> bool:
    if not _PATTERN.fullmatch(pattern):
        return False
    return name == pattern or (pattern[0] == "*" and name.endswith(pattern[1:]))
