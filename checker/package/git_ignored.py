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


def ignored_by(package: Package, path: str) -> str:
    """Return the line of a `.gitignore` that excludes a file of this name: `.gitignore:3`.

    Lines that are a name, or its end after an asterisk (`*.pcd`), count; others are not read.
    """
    name = posixpath.basename(path)
    for source in files_around(package, _NAMES):
        for number, line in enumerate(source.text.splitlines(), 1):
            pattern = line.strip()
            if not _PATTERN.fullmatch(pattern):
                continue
            if name == pattern or (pattern[0] == "*" and name.endswith(pattern[1:])):
                return f"{source.file}:{number}"
    return ""
