"""Folders of containers: what is below the working folder of a Dockerfile is found in it."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.package.files_above import files_around

if TYPE_CHECKING:
    from checker.package.package import Package

_DOCKERFILE = re.compile(r"(?:\A|/)(?:dockerfile[^/]*|[^/]+\.dockerfile)\Z")
_WORKDIR = re.compile(
    r"^[ \t]*(?:FROM\b|WORKDIR[ \t]+[\"']?([\w./${}-]{1,300})[\"']?[ \t]*$)", re.M | re.I
)
_WRITTEN = re.compile(r">[ \t]*([^\s\"';&|]{1,300})")
"""A file into which a command writes what it prints."""
_OF_EVERY_SYSTEM = ("", "home", "root", "opt", "tmp")
"""Folders that every system has: what is in them on another machine is not known."""


def container_with(package: Package, path: str) -> str:
    """Return the Dockerfile in whose container an absolute path is; empty if there is none.

    Args:
        package: Its Dockerfiles, and those around it, count.
        path: The path, or the URI of one: that of a file below a `WORKDIR`.
    """
    location = path.strip().removeprefix("file://")
    for name, folder in _working_folders(package):
        if posixpath.normpath(location).startswith(f"{folder}/"):
            return name
    return ""


def is_made_in_container(package: Package, path: str) -> bool:
    """Return whether a command of a Dockerfile writes a file, as `xacro … > urdf/arm.urdf` does.

    Args:
        package: Its Dockerfiles, and those around it, count.
        path: The path as the package lists it; `../other/…` is a sibling's.
    """
    inside = path.removeprefix("../") if path.startswith("../") else f"{package.root.name}/{path}"
    texts = (source.text for source in files_around(package, _DOCKERFILE))
    written = (path for text in texts if inside in text for path in _WRITTEN.findall(text))
    return any(path.endswith(f"/{inside}") for path in written)


def _working_folders(package: Package) -> Iterator[tuple[str, str]]:
    """Yield working folders, each with its Dockerfile; one that is relative extends the former.

    Each `FROM` begins at `/`. What a variable is part of is not known, nor what extends that.
    """
    for source in files_around(package, _DOCKERFILE):
        folder = "/"
        for match in _WORKDIR.finditer(source.text):
            folder = posixpath.normpath(posixpath.join(folder, match[1])) if match[1] else "/"
            if "$" not in folder and folder.strip("/") not in _OF_EVERY_SYSTEM:
                yield source.file, folder
