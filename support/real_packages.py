"""Folders of real packages, where environment variables name them.

A variable that is unset, empty or names no folder means that there are none: what needs them is
skipped. Tests look at the folders that `real_packages.json` lists, so that new packages make no
test fail; these are counted at the end of a run.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

CORPUS = "SUBT_CHECK_CORPUS"
"""Submitted robots, one folder each."""
REVIEWS = "SUBT_CHECK_REVIEWS"
"""Corrected faults: packages before and after."""
MODERN = "SUBT_CHECK_MODERN"
"""Packages of today's Gazebo and ROS."""
REPORTS = "SUBT_CHECK_REPORTS"
"""Faults that people reported in public, rebuilt: `bad` and `good` packages of each."""
MJCF = "SUBT_CHECK_MJCF"
"""Models of MuJoCo: robots, `bugs` with corrected faults, `repro` with small ones."""
URDFS = "SUBT_CHECK_URDFS"
"""The folder `robots` of example-robot-data, where that package is not installed."""
_OWN_TESTS = {"bugs", "repro"}
"""Folders of MODERN with faults, rebuilt or as they were: not packages to be judged."""


def named_folder(variable: str) -> Path | None:
    """Return the folder that a variable names; None if there is none."""
    name = os.environ.get(variable, "").strip()
    folder = Path(name).absolute()
    return folder if name and folder.is_dir() else None


def needed_folder(variable: str) -> Path:
    """Return the folder that a variable names, or skip the test."""
    folder = named_folder(variable)
    if folder is None:
        pytest.skip(f"{variable} names no folder of real packages")
    return folder


@cache
def _judged_names() -> dict[str, list[str]]:
    table = Path(__file__).parent / "real_packages.json"
    names: dict[str, list[str]] = json.loads(table.read_text("utf-8"))
    return names


def judged_folders(variable: str) -> list[Path]:
    """Return the judged folders below the one that a variable names; none if it is unset."""
    folder = named_folder(variable)
    paths = [folder / name for name in _judged_names()[variable]] if folder else []
    return [path for path in paths if path.is_dir()]


def judged_files(variable: str, name: str) -> list[Path]:
    """Return the files of a name that are in judged folders."""
    files = (folder / name for folder in judged_folders(variable))
    return [file for file in files if file.is_file()]


def not_judged() -> Iterator[str]:
    """Yield a line for each variable with folders that are not judged yet."""
    for variable in (CORPUS, REVIEWS, MODERN, REPORTS):
        folder = named_folder(variable)
        there = [path.name for path in folder.iterdir() if path.is_dir()] if folder else []
        others = sorted({*there} - {*_judged_names()[variable]} - _OWN_TESTS)
        if others:
            yield f"{variable}: {len(others)} folders are not judged yet: {', '.join(others)}"


def needs(variable: str) -> list[pytest.MarkDecorator]:
    """Return the marks of tests that are skipped without the folder of a variable."""
    absent = named_folder(variable) is None
    reason = f"{variable} names no folder of real packages"
    return [pytest.mark.corpus, pytest.mark.skipif(absent, reason=reason)]
