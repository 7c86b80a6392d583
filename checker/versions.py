"""The versions that a report names."""

from __future__ import annotations

import platform
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version

LIBRARIES = ("mujoco", "pin", "trimesh")
"""What drives the robot, weighs it and reads its meshes: figures may differ between versions."""


def tool_version() -> str:
    """Return the version of subt-check; `unknown` when it runs without being installed."""
    try:
        return version("subt-check")
    except PackageNotFoundError:
        return "unknown"


def versions() -> dict[str, str]:
    """Return the versions that a result depends on; nothing is imported for it."""
    found = {"subt-check": tool_version(), "python": platform.python_version()}
    for library in LIBRARIES:
        with suppress(PackageNotFoundError):
            found[library] = version(library)
    return found
