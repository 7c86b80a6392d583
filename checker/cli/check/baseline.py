"""`--write-baseline`: write the current findings to the baseline file."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping
from pathlib import Path

from checker.base.errors import CheckerError, InvalidSettings
from checker.base.output import write
from checker.base.words import and_list, count, plain
from checker.report.report import PackageReport, Report, ReportedFinding
from checker.rulebook.suppression.baseline import (
    Baseline,
    BaselineEntry,
    baseline_text,
    read_baseline,
)
from checker.rulebook.suppression.baseline_match import match_entries
from checker.rulebook.suppression.finding_places import spots_of


def baseline_to_renew(file: Path) -> Baseline:
    """Return the baseline to update; an empty one when there is none yet.

    Raises:
        InvalidSettings: The file is something else, which is not overwritten, or cannot be read.
    """
    before = read_baseline(file)
    if before.missing:
        return Baseline(file)
    if before.fault:
        raise InvalidSettings(file, f"{before.fault}; remove it, or name another file")
    return before


def write_baseline(before: Baseline, report: Report, rules: Collection[str]) -> str:
    """Write the findings of a report, and return a sentence about it.

    Args:
        before: The baseline as it was; entries of packages that were not checked stay.
        report: The report of a check without a baseline.
        rules: Ids of all rules.

    Raises:
        CheckerError: The file cannot be written, or two packages have one name.
    """
    if before.path is None:
        raise CheckerError("a baseline without a file cannot be written")
    _refuse_equal_names(report)
    packages = dict(before.packages)
    for package in report.packages:
        packages[package.name] = _entries(package, before.packages.get(package.name, ()), rules)
    write(before.path, _text(before.path, packages))
    findings = count(sum(len(packages[package.name]) for package in report.packages), "finding")
    where = count(len(report.packages), "package")
    return f"{plain(str(before.path))} contains {findings} of {where}\n"


def _refuse_equal_names(report: Report) -> None:
    paths: dict[str, list[str]] = {}
    for package in report.packages:
        paths.setdefault(package.name, []).append(package.path)
    for name, places in paths.items():
        if len(places) > 1:
            raise CheckerError(
                f"{and_list(places[:3])} are packages with the same name, {name}, which a baseline "
                "cannot distinguish; write a baseline for each, with --baseline FILE"
            )


def _text(path: Path, packages: Mapping[str, tuple[BaselineEntry, ...]]) -> str:
    try:
        return baseline_text(packages)
    except ValueError as error:
        raise CheckerError(
            f"{path} {error}; write a baseline for fewer packages or rules"
        ) from None


def _entries(
    package: PackageReport, before: tuple[BaselineEntry, ...], rules: Collection[str]
) -> tuple[BaselineEntry, ...]:
    """Return the entries of a package: its findings of now, with the reasons that users gave.

    What rules stated that did not look this time stays.
    """
    spots = [
        (at, spot) for at, finding in enumerate(package.findings) for spot in spots_of(finding)
    ]
    known = match_entries([spot for _, spot in spots], before)
    reasons: dict[int, str] = {}
    for (at, _), entry in zip(spots, known.entries, strict=True):
        if entry is not None and before[entry].reason:
            reasons.setdefault(at, before[entry].reason)
    now = [_entry(finding, reasons.get(at, "")) for at, finding in enumerate(package.findings)]
    stale = [before[at] for at in known.stale]
    kept = [entry for entry in stale if entry.rule in rules and entry.rule not in package.looked]
    return (*now, *kept)


def _entry(finding: ReportedFinding, reason: str) -> BaselineEntry:
    spots = list(spots_of(finding))
    places = Counter(spot.place for spot in spots)
    return BaselineEntry(
        finding.rule, finding.severity, finding.message, dict(places), spots[0].key, reason
    )
