"""README, container, CI and build files: of a package, and at the top of the folders around it.

What stands in an HTML comment of a README is not shown to readers, and is left out.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.source.text import SourceText

if TYPE_CHECKING:
    from checker.package.package import Package

README = re.compile(r"\A(?:\.\./)*readme(?:[._-][a-z]{2}(?:[_-][a-z]{2,4})?)?(?:\.\w{1,8})?\Z")
"""Paths in lower case of README files of a package and above it, also `readme_zh.md`."""
_LEVELS = 8
_FENCE_OR_COMMENT = re.compile(
    r"^ {0,3}(?P<fence>```|~~~).*?(?:^ {0,3}(?P=fence)|\Z)|<!--.*?-->",
    re.DOTALL | re.MULTILINE,
)
"""A block of code or a comment of Markdown: a `<!--` in a block of code is a part of the code."""
_NOT_LINE_END = re.compile(r"[^\r\n]")
_SIZE_LIMIT = 500_000
_ITEMS = 5_000
_PLACES = (".", ".devcontainer", ".docker", ".github/workflows", ".vscode", "docker", "install")
"""Folders whose files are read; colcon writes `install`."""


def own_files(package: Package, names: re.Pattern[str]) -> list[SourceText]:
    """Return the files of a package whose paths in lower case `names` finds."""
    paths = (file.path for file in package.index.files if names.search(file.path.lower()))
    read = map(package.read, paths)
    return [_shown(source) for source in read if isinstance(source, SourceText)]


def files_around(package: Package, names: re.Pattern[str]) -> Iterator[SourceText]:
    """Yield the files of a package, then those of the folders around it; see `files_above`."""
    yield from own_files(package, names)
    for sources in files_above(package, names):
        yield from sources


def files_above(package: Package, names: re.Pattern[str]) -> list[tuple[SourceText, ...]]:
    """Return the files of each folder around a package, the nearest folder first.

    The first folder is the one with the package's siblings, or with a single file; the others are
    above it, up to the folder that the user gave. Nothing above that is read, and nothing around
    a file that is given alone.

    Args:
        package: A package, a folder with a model, or a file.
        names: Which paths to read, in lower case, from the package: `../readme.md`.
    """
    tops = islice(_tops(package), _LEVELS)
    return [tuple(_files_of(package, top, names)) for top in tops]


def _tops(package: Package) -> Iterator[Path]:
    given = package.workspace.given
    top = package.root if package.only else package.root.parent
    if given is not None or not package.only:
        yield top
    while given is not None and top != given and top.is_relative_to(given):
        top = top.parent
        yield top


def _files_of(package: Package, top: Path, names: re.Pattern[str]) -> Iterator[SourceText]:
    for folder in _PLACES:
        for location in _files(top / folder):
            path = Path(os.path.relpath(location, package.root)).as_posix()
            if names.search(path.lower()):
                read = package.workspace.overlay.read(location, path, _SIZE_LIMIT)
                if isinstance(read, SourceText):
                    yield _shown(read)


def _shown(source: SourceText) -> SourceText:
    """Return a file with blanks for what a reader of a README does not see, else as it is."""
    last = source.text.rfind("-->")
    if last < 0 or not README.match(source.file.lower()):
        return source
    last += len("-->")
    shown = _FENCE_OR_COMMENT.sub(
        lambda found: found[0] if found["fence"] else _NOT_LINE_END.sub(" ", found[0]),
        source.text[:last],
    )
    return replace(source, text=shown + source.text[last:])


def _files(folder: Path) -> list[Path]:
    """Return the files of a folder; links are not followed."""
    if folder.is_symlink() or folder.parent.is_symlink():
        return []
    try:
        with os.scandir(folder) as items:
            some = [item for item in islice(items, _ITEMS) if item.is_file(follow_symlinks=False)]
    except OSError:
        return []
    return sorted(Path(item.path) for item in some)
