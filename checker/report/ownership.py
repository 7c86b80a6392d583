"""The owners of a finding: several packages may report the same place of a file that they share."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from checker.base.record import Record
from checker.finding import Place
from checker.report.finding_text import path_of
from checker.report.report import PackageReport, Report, ReportedFinding

Identity = tuple[str, int, int, str, str]


def identity(package: PackageReport, finding: ReportedFinding) -> Identity:
    """Return what is equal for one fault that several packages report: path, place and words."""
    place = finding.places[0]
    path = path_of(place, package)
    return path, place.line, place.column, finding.rule, finding.message


def is_foreign(place: Place) -> bool:
    """Return whether a place is outside the package that the report is about."""
    return place.file.startswith("../")


def owners(report: Report) -> Mapping[Identity, str]:
    """Return the name of the package that owns the file of each finding."""
    known: dict[Identity, str] = {}
    for package in report.packages:
        known |= owned_by(package)
    return known


def owned_by(package: PackageReport) -> dict[Identity, str]:
    """Return the findings that are in a package's own files, each with its name."""
    return {
        identity(package, finding): package.name
        for finding in package.findings
        if not is_foreign(finding.places[0])
    }


def foreign_findings(package: PackageReport) -> Iterator[ReportedFinding]:
    """Yield what a package reports of files of others."""
    return (finding for finding in package.findings if is_foreign(finding.places[0]))


class Share(Record):
    """Findings for one package.

    Attributes:
        own: Findings to report for this package.
        elsewhere: Counts of findings that are reported for other packages, by their names.
    """

    own: tuple[ReportedFinding, ...]
    elsewhere: Mapping[str, int]


def share_of(package: PackageReport, owner_of: Mapping[Identity, str]) -> Share:
    """Set apart the findings in another package's files that its own report contains too.

    Args:
        package: The package whose findings to separate.
        owner_of: The result of `owners`.
    """
    own: list[ReportedFinding] = []
    elsewhere: dict[str, int] = {}
    for finding in package.findings:
        owner = owner_of.get(identity(package, finding))
        if owner is not None and is_foreign(finding.places[0]):
            elsewhere[owner] = elsewhere.get(owner, 0) + 1
        else:
            own.append(finding)
    return Share(tuple(own), elsewhere)


def each_once(report: Report) -> Iterator[tuple[PackageReport, ReportedFinding]]:
    """Yield every finding once, however many packages share the file it is in."""
    owner_of, seen = owners(report), set[Identity]()
    for package in report.packages:
        for finding in share_of(package, owner_of).own:
            known = identity(package, finding)
            if not (is_foreign(finding.places[0]) and known in seen):
                yield package, finding
            seen.add(known)
