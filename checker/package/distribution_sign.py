"""ROS 2 distribution in the container files, CI files and README of a package."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.source.text import SourceText

if TYPE_CHECKING:
    from checker.package.package import Package

_DISTROS = "foxy|galactic|humble|iron|jazzy|kilted|lyrical|rolling"
_NAMED = re.compile(
    rf"(?:\bros[ -]?2?[ :_/-]{{1,3}}|\bros_distro\W{{1,4}}|\bros_distribution\W{{1,4}})"
    rf"\(?({_DISTROS})\b",
    re.IGNORECASE,
)
"""`ros:humble-perception`, `ROS_DISTRO=humble`, `/opt/ros/humble`, `ros-humble-xacro`."""
_CONTAINER = re.compile(r"(?:\A|/)(?:dockerfile[^/]*|[^/]+\.dockerfile|devcontainer\.json)\Z")
_CI = re.compile(r"(?:\A|/)(?:\.github/workflows/[^/]+\.ya?ml|\.gitlab-ci\.yml)\Z")
_README = re.compile(r"\A(?:\.\./)?readme(?:\.\w{1,4})?\Z")
_SIZE_LIMIT = 500_000
_ITEMS = 5_000


class DistributionSign(Record):
    """A distribution, and its source: `Dockerfile:1 names ros:humble`."""

    distro: str
    words: str


def distribution_sign(package: Package) -> DistributionSign | None:
    """Return the distribution that a package is made for; None if there is no sign, or several.

    A container file counts before CI, and both before the README; of the repository around the
    package those at its top count too.
    """
    sources = [*_sources(package)]
    for pattern in (_CONTAINER, _CI, _README):
        chosen = (source for source in sources if pattern.search(source.file.lower()))
        found = [(source, match) for source in chosen for match in _NAMED.finditer(source.text)]
        distros = {match[1].lower() for _, match in found}
        if len(distros) == 1:
            source, match = found[0]
            line, _ = source.position(match.start())
            words = " ".join(match.group().split())
            return DistributionSign(distros.pop(), f"{source.file}:{line} names {words}")
        if distros:
            return None
    return None


def _sources(package: Package) -> Iterator[SourceText]:
    for file in package.index.files:
        if _tells(file.path) and isinstance(source := package.read(file.path), SourceText):
            yield source
    if not package.only:
        yield from _files_above(package)


def _tells(path: str) -> bool:
    return any(pattern.search(path.lower()) for pattern in (_CONTAINER, _CI, _README))


def _files_above(package: Package) -> Iterator[SourceText]:
    """Yield the files at the top of the folder that the package and its siblings are in."""
    top = package.workspace.directories[0]
    for folder in (".", ".devcontainer", ".github/workflows"):
        for location in _files(top / folder):
            path = location.relative_to(top).as_posix()
            if _tells(path):
                read = package.workspace.overlay.read(location, f"../{path}", _SIZE_LIMIT)
                if isinstance(read, SourceText):
                    yield read


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
