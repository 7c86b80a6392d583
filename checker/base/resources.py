"""What comes with the checker beside its code: tables of facts (`checker/data`), and templates."""

from __future__ import annotations

import json
import platform
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

LIBRARIES = ("mujoco", "pin")
"""What drives the robot and weighs it: figures may differ between versions."""
UNKNOWN = "unknown"
_CHECKER = Path(__file__).parents[1]


@cache
def version_of(name: str) -> str:
    """Return the version of an installed distribution without importing it; else `UNKNOWN`.

    Many keys of the cache hold it: `importlib.metadata.version`, which parses all of the same file,
    takes four times as long.
    """
    try:
        lines = (metadata.distribution(name).read_text("METADATA") or "").splitlines()
    except metadata.PackageNotFoundError:
        return UNKNOWN
    field = "Version: "
    return next((line[len(field) :] for line in lines if line.startswith(field)), UNKNOWN)


def tool_version() -> str:
    """Return the version of subt-check; `unknown` when it runs without being installed."""
    return version_of("subt-check")


def versions() -> dict[str, str]:
    """Return the versions that a result depends on; nothing is imported for it."""
    known_versions = {"subt-check": tool_version(), "python": platform.python_version()}
    known = {library: version_of(library) for library in LIBRARIES}
    return known_versions | {
        library: number for library, number in known.items() if number != UNKNOWN
    }


@cache
def table(name: str) -> Any:
    """Return a JSON table by its file name without `.json`; read once.

    Raises:
        FileNotFoundError: There is no such table.
    """
    return json.loads((_CHECKER / "data" / f"{name}.json").read_text("utf-8"))


def templates(name: str) -> Path:
    """Return a folder of templates."""
    return beside("templates") / name


def beside(name: str) -> Path:
    """Return a folder that the wheel has below `checker`, and a checkout beside it."""
    installed = _CHECKER / name
    return installed if installed.is_dir() else _CHECKER.parent / name
