"""Data files of the checker: tables of facts (`checker/data`), and templates."""

from __future__ import annotations

import json
import os
import sys
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

LIBRARIES = ("mujoco", "pin")
"""Libraries of the trial and the masses: figures may differ between their versions."""
UNKNOWN = "unknown"
PACKAGE = __name__.partition(".")[0]
"""Import name of this code: `checker` in a checkout, `subt_check` in an installed wheel."""
_IS_INSTALLED = PACKAGE == "subt_check"
RULES = f"{PACKAGE}.rules" if _IS_INSTALLED else "rules"
"""The package of our rules."""
OWN_CODE = ("",) if _IS_INSTALLED else ("", "../rules")
"""Folders with the code of the checker and of its rules, relative to its package."""
_CHECKER = Path(__file__).parents[1]


@cache
def version_of(name: str) -> str:
    """Return the version of an installed distribution without importing it; else `UNKNOWN`.

    The folder of its metadata is named for it. To load `importlib.metadata` takes longer than all
    that a cache's key includes.
    """
    return _versions().get(name.lower().replace("-", "_"), UNKNOWN)


@cache
def _versions() -> dict[str, str]:
    """Return the versions of all that is installed, what comes first on the path first."""
    known: dict[str, str] = {}
    for folder in metadata_folders():
        name, _, version = folder.name.removesuffix(".dist-info").partition("-")
        known.setdefault(name.lower().replace(".", "_"), version)
    return known


@cache
def metadata_folders() -> tuple[Path, ...]:
    """Return the folders with the metadata of all that is installed."""
    found: list[Path] = []
    for place in dict.fromkeys(sys.path):
        with suppress(OSError), os.scandir(place or ".") as items:
            found += [Path(item.path) for item in items if item.name.endswith(".dist-info")]
    return tuple(found)


def tool_version() -> str:
    """Return the version of subt-check; `unknown` when it runs without being installed."""
    return version_of("subt-check")


def versions() -> dict[str, str]:
    """Return the versions that a result depends on; nothing is imported for it."""
    known_versions = {"subt-check": tool_version(), "python": sys.version.partition(" ")[0]}
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
    return project_folder("templates") / name


def project_folder(name: str) -> Path:
    """Return a folder that the wheel has below `subt_check`, and a checkout next to it."""
    installed = _CHECKER / name
    return installed if installed.is_dir() else _CHECKER.parent / name


def processors() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
