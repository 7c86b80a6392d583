"""A package's report as JSON that can be read back, for the cache: nothing is left out."""

from __future__ import annotations

from base64 import b64decode, b64encode
from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any

from checker.finding import Edit, Fix, Place, Safety, Severity
from checker.report.report import (
    Cause,
    Display,
    InheritedPart,
    NotChecked,
    PackageReport,
    Picture,
    ReportedFinding,
    Suppressed,
    SuppressedBy,
)


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
        KeyError, TypeError, ValueError: It is no stored report.
    """
    return PackageReport(
        **{
            **said,
            "path": path,
            "findings": tuple(_finding(each) for each in said["findings"]),
            "not_checked": tuple(
                NotChecked(each["rule"], each["reason"], Cause(each["cause"]))
                for each in said["not_checked"]
            ),
            "inherited": tuple(InheritedPart(**each) for each in said["inherited"]),
            "fail_on": Severity(said["fail_on"]),
            "suppressed": tuple(_suppressed(each) for each in said["suppressed"]),
            "display": _display(said["display"]),
            "looked": tuple(said["looked"]),
        }
    )


def _suppressed(said: Mapping[str, Any]) -> Suppressed:
    place = Place(**said["place"]) if said["place"] is not None else None
    return Suppressed(_finding(said["finding"]), SuppressedBy(said["by"]), said["reason"], place)


def _to_text(said: dict[str, Any]) -> dict[str, Any]:
    """Make JSON's strings of what is bytes."""
    pictures = [
        {**each, "jpeg": b64encode(each["jpeg"]).decode("ascii")} for each in said["pictures"]
    ]
    return {**said, "glb": b64encode(said["glb"]).decode("ascii"), "pictures": pictures}


def _display(said: Mapping[str, Any] | None) -> Display | None:
    if said is None:
        return None
    pictures = (Picture(**{**each, "jpeg": b64decode(each["jpeg"])}) for each in said["pictures"])
    return Display(b64decode(said["glb"]), tuple(pictures), tuple(said["notes"]))


def _finding(said: Mapping[str, Any]) -> ReportedFinding:
    found = ReportedFinding(**{**said, "fix": None})
    return replace(
        found,
        severity=Severity(said["severity"]),
        places=tuple(Place(**place) for place in said["places"]),
        fix=_fix(said["fix"]),
    )


def _fix(said: Mapping[str, Any] | None) -> Fix | None:
    if said is None:
        return None
    edits = (Edit(**{**each, "place": Place(**each["place"])}) for each in said["edits"])
    return Fix(Safety(said["safety"]), tuple(edits))
