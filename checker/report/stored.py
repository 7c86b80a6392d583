"""A package's report as JSON that can be read back, for the cache: nothing is left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any

from checker.finding import Edit, Fix, Place, Safety, Severity
from checker.report.report import Cause, InheritedPart, NotChecked, PackageReport, ReportedFinding


def to_stored(report: PackageReport) -> dict[str, Any]:
    """Return what `from_stored` makes the same report of."""
    return asdict(report)


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
        }
    )


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
