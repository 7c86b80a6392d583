"""The versions that a report names."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version


def tool_version() -> str:
    """Return the version of subt-check; `unknown` when it runs without being installed."""
    try:
        return version("subt-check")
    except PackageNotFoundError:
        return "unknown"


def versions() -> dict[str, str]:
    """Return the versions that a result depends on."""
    return {"subt-check": tool_version(), "python": platform.python_version()}
