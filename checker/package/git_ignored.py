"""Files that `.gitignore` keeps out of a repository."""

from __future__ import annotations

import os
import posixpath
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from checker.package.files_above import files_around
from checker.source.text import SourceText

if TYPE_CHECKING:
    from checker.package.package import Package

_FILE = ".gitignore"
_NAMES = re.compile(r"\A(?:\.\./)*\.gitignore\Z")


def ignored_by(package: Package, path: str) -> str:
    """Return the line of a `.gitignore` that excludes a file: `.gitignore:3`; else nothing.

    Args:
        package: The package, up to whose workspace each folder above is looked at.
        path: The path of the file from the package's folder.
    """
    from pathspec import GitIgnoreSpec

    location = Path(os.path.normpath(package.root / path))
    for source in (*_beside(package, path), *files_around(package, _NAMES)):
        folder = Path(os.path.normpath(package.root / source.file)).parent
        if location.is_relative_to(folder):
            lines = source.text.splitlines()
            found = GitIgnoreSpec.from_lines(line or "#" for line in lines).check_file(
                location.relative_to(folder).as_posix()
            )
            if found.index is not None:
                return f"{source.file}:{found.index + 1}" if found.include else ""
    return ""


def _beside(package: Package, path: str) -> Iterator[SourceText]:
    """Yield those in the folders of a package that lead to a file, the nearest first."""
    folder = posixpath.dirname(posixpath.normpath(path))
    while folder and not folder.startswith((".", "/")):
        source = package.read(f"{folder}/{_FILE}")
        if isinstance(source, SourceText):
            yield source
        folder = posixpath.dirname(folder)
