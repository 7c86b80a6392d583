"""A package's report as JSON that can be read back, for the cache: nothing is left out."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any

from checker.report.reading import read_as
from checker.report.report import PackageReport


def to_stored(report: PackageReport) -> dict[str, Any]:
    """Return what `from_stored` makes the same report of."""
    display = report.display
    return {
        **asdict(replace(report, display=None)),
        "display": None if display is None else _to_text(asdict(display)),
    }


def from_stored(said: Mapping[str, Any], path: str) -> PackageReport:
    """Return the report that was stored.

    Args:
        said: As `to_stored` made it.
        path: Of the package, as the user gives it this time.

    Raises:
        Unfit, TypeError: It is no stored report.
    """
    return replace(read_as(PackageReport, said), path=path)


def _to_text(said: dict[str, Any]) -> dict[str, Any]:
    """Make JSON's strings of what is bytes."""
    pictures = [
        {**each, "jpeg": b64encode(each["jpeg"]).decode("ascii")} for each in said["pictures"]
    ]
    return {**said, "glb": b64encode(said["glb"]).decode("ascii"), "pictures": pictures}
