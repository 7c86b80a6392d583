"""What `--write-baseline` does: puts the findings of now into the baseline's file."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from checker.errors import CheckerError, InvalidSettings
from checker.output import write
from checker.report.report import PackageReport, Report, ReportedFinding
from checker.report.wording import count, plain
from checker.suppression.baseline import (
    DEFAULT_FILE,
    Baseline,
    BaselineEntry,
    baseline_text,
    read_baseline,
)
from checker.suppression.matching import matched


def baseline_to_renew(path: str | None) -> Baseline:
    """Return the baseline that shall be written anew; an empty one when there is none yet.

    Raises:
        InvalidSettings: The file is something else, which is not overwritten.
    """
    file = Path(path or DEFAULT_FILE)
    if not file.exists():
        return Baseline(file)
    before = read_baseline(file)
    if before.fault:
        raise InvalidSettings(file, f"{before.fault}; remove it, or name another file")
    return before


def write_baseline(before: Baseline, report: Report, rules: Collection[str]) -> str:
    """Write the findings of a report, and return a sentence about it.

    Args:
        before: As it was; entries of packages that were not checked stay.
        report: Of a check without a baseline.
        rules: Ids of all rules.

    Raises:
        CheckerError: The file cannot be written.
    """
    if before.path is None:
        raise CheckerError("a baseline without a file cannot be written")
    packages = dict(before.packages)
    for package in report.packages:
        packages[package.name] = _entries(package, before.packages.get(package.name, ()), rules)
    write(before.path, baseline_text(packages))
    said = count(sum(len(packages[package.name]) for package in report.packages), "finding")
    where = count(len(report.packages), "package")
    return f"{plain(str(before.path))} holds {said} of {where}\n"


def _entries(
    package: PackageReport, before: tuple[BaselineEntry, ...], rules: Collection[str]
) -> tuple[BaselineEntry, ...]:
    """Return the entries of a package: its findings of now, with the reasons that users gave.

    What rules said that did not look this time stays.
    """
    known = matched(package.findings, before)
    kept = [each for each in known.stale if each.rule in rules and each.rule not in package.looked]
    return (*(_entry(*each) for each in known.findings), *kept)


def _entry(finding: ReportedFinding, before: BaselineEntry | None) -> BaselineEntry:
    reason = before.reason if before else ""
    key = "" if finding.key == finding.message else finding.key
    return BaselineEntry(finding.fingerprint, finding.rule, finding.message, key, reason)
