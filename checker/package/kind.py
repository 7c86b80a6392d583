"""What kind of package it is: a rule must not ask a plugin for its spawner."""

from __future__ import annotations

import re
from enum import StrEnum
from typing import TYPE_CHECKING

from checker.package.inheritance import SPAWNER, SUBMISSION_NAME
from checker.package.model_file import own_model
from checker.source.text import SourceText

if TYPE_CHECKING:
    from checker.package.package import Package

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
