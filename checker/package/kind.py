"""What kind of package it is: a rule must not ask a plugin for its spawner."""

from __future__ import annotations

import os
import re
from enum import StrEnum
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from checker.package.inheritance import SPAWNER, SUBMISSION_NAME
from checker.package.model_file import own_model
from checker.source.text import SourceText

if TYPE_CHECKING:
    from checker.package.package import Package


# What makes a folder a package, before anything in it is read.


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


_ADD_LIBRARY = re.compile(r"^[ \t]{0,80}add_library[ \t]{0,8}\(", re.MULTILINE | re.IGNORECASE)


class PackageKind(StrEnum):
    """What a package is meant to be.

    `ROBOT`: a submission with a model of its own (or that ought to have one). `CONFIGURATION`: a
    submission whose model is a sibling's. `PLUGIN`: libraries only. `BASE_MODEL`: a model that
    others build on, without a spawner. `URDF_DESCRIPTION`: URDF or xacro without an SDF model.
    """

    ROBOT = "robot"
    CONFIGURATION = "configuration"
    PLUGIN = "plugin"
    BASE_MODEL = "base_model"
    URDF_DESCRIPTION = "urdf_description"
    SINGLE_FILE = "single_file"
    UNKNOWN = "unknown"


def kind_of(package: Package) -> PackageKind:
    """Tell a package's kind from the files it holds.

    A package that calls itself a submission, or bridges topics, is a robot even when its spawner
    was forgotten; otherwise the missing file would excuse itself.
    """
    if package.only:
        return PackageKind.SINGLE_FILE
    if package.base is not None:
        return PackageKind.CONFIGURATION
    submission = SUBMISSION_NAME.search(package.name) is not None
    if submission or package.exists(SPAWNER) or package.exists("launch/vehicle_topics.launch"):
        return PackageKind.ROBOT
    if own_model(package) is not None:
        return PackageKind.BASE_MODEL
    if package.index.with_suffix(".urdf", ".xacro"):
        return PackageKind.URDF_DESCRIPTION
    return PackageKind.PLUGIN if _carries_library(package) else PackageKind.UNKNOWN


def _carries_library(package: Package) -> bool:
    if package.index.with_suffix(".so"):
        return True
    build = package.read("CMakeLists.txt")
    return isinstance(build, SourceText) and _ADD_LIBRARY.search(build.text) is not None
