"""What makes a folder a package, before anything in it is read."""

from __future__ import annotations

import os
from itertools import islice
from pathlib import Path

MARKERS = ("package.xml", "model.config", "model.sdf", "launch/spawner.rb")
MODEL_SUFFIXES = (".sdf", ".world", ".urdf", ".xacro")


def looks_like_package(folder: Path) -> bool:
    """Say whether a folder holds one of the files that only a package has."""
    return any(_is_file(folder / marker) for marker in MARKERS)


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:
        return False


def holds_loose_models(folder: Path) -> bool:
    """Say whether model files lie in a folder, or in its `urdf/`, without a package around."""
    return any(
        name.lower().endswith(MODEL_SUFFIXES)
        for place in (folder, folder / "urdf")
        for name in _names(place)
    )


def enclosing_package(place: Path, levels: int = 3) -> Path | None:
    """Return the nearest package folder around (or at) a folder, at most `levels` up."""
    around = islice((place, *place.parents), levels)
    return next((folder for folder in around if looks_like_package(folder)), None)


def _names(folder: Path) -> list[str]:
    try:
        with os.scandir(folder) as items:
            return [item.name for item in islice(items, 5_000) if item.is_file()]
    except OSError:
        return []
