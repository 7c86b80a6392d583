"""File of a package that is its model."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from checker.package.formats import formats
from checker.package.index import normal_path
from checker.source.xml import XmlDocument

if TYPE_CHECKING:
    from checker.package.package import Package

_VERSION = re.compile(r"(\d{1,4})\.(\d{1,4})")


def own_model(package: Package) -> str | None:
    """Return the path of the model in a package itself, or None.

    The newest `<sdf>` that model.config names and that is there, else model.sdf, else the only
    file of a robot at the top of the package.
    """
    if package.only:
        return package.only
    for path in [*_named_in_config(package), "model.sdf"]:
        entry = package.index.find(path)
        if entry is not None and entry.is_file:
            return path
    at_top = [file.path for file in package.index.with_suffix(*_suffixes()) if "/" not in file.path]
    return at_top[0] if len(at_top) == 1 else None


def _suffixes() -> list[str]:
    return [each.suffixes[0] for each in formats() if not each.is_grouped]


def _named_in_config(package: Package) -> list[str]:
    if package.index.find("model.config") is None:
        return []
    config = package.xml("model.config")
    if not isinstance(config, XmlDocument):
        return []
    named = sorted(config.root.all("sdf"), key=lambda sdf: _version(sdf.get("version") or ""))
    paths = (normal_path(sdf.text.value) for sdf in reversed(named))
    return [path for path in paths if path is not None]


def _version(text: str) -> tuple[int, int]:
    match = _VERSION.match(text)
    return (int(match[1]), int(match[2])) if match else (0, 0)
