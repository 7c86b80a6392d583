"""Folders of real packages, where environment variables name them.

A variable that is unset, empty or names no folder means that there are none: what needs them is
skipped.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

CORPUS = "SUBT_CHECK_CORPUS"
"""Submitted robots, one folder each."""
REVIEWS = "SUBT_CHECK_REVIEWS"
"""Corrected faults: packages before and after."""
MODERN = "SUBT_CHECK_MODERN"
"""Packages of today's Gazebo and ROS."""


def named_folder(variable: str) -> Path | None:
    """Return the folder that a variable names; None where there is none."""
    name = os.environ.get(variable, "").strip()
    folder = Path(name).absolute()
    return folder if name and folder.is_dir() else None


def needed_folder(variable: str) -> Path:
    """Return the folder that a variable names, or skip the test."""
    folder = named_folder(variable)
    if folder is None:
        pytest.skip(f"{variable} names no folder of real packages")
    return folder


def needs(variable: str) -> pytest.MarkDecorator:
    """Return the mark of tests that are skipped without the folder of a variable."""
    absent = named_folder(variable) is None
    return pytest.mark.skipif(absent, reason=f"{variable} names no folder of real packages")
