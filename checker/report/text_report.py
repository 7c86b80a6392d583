"""The report for a person at a terminal."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from checker.report.fact_words import facts_in_words
from checker.report.finding_text import MESSAGE_LIMIT, finding_text
from checker.report.ownership import Identity, owners, share_of
from checker.report.palette import Palette
from checker.report.report import (
    Cause,
    NotChecked,
    NotOpened,
    PackageReport,
    Report,
    ReportedFinding,
)
from checker.report.summary import summary_text
from checker.report.suppressed_text import suppressed_text
from checker.report.trial_text import trial_text
from checker.report.verdict import sentence
from checker.report.wording import count, listed, plain, shortened

SHOWN_LIMIT = 200
"""Findings of one package that are shown in full; the rest is counted."""


def to_text(report: Report, palette: Palette) -> str:
    """Return the whole report."""
    said_by = owners(report)
    explained: set[str] = set()
    blocks = [_package(package, said_by, explained, palette) for package in report.packages]
    if len(report.packages) > 1:
        blocks.append(summary_text(report.packages, palette))
    if skipped := [_skipped(each) for each in report.not_opened if not each.failed]:
        blocks.append("".join(skipped))
    return "\n".join(blocks)


def _package(
    package: PackageReport,
    said_by: Mapping[Identity, str],
    explained: set[str],
    palette: Palette,
) -> str:
    share = share_of(package, said_by)
    kind = package.kind.replace("_", " ") + _profile(package)
    lines = [palette.bold(plain(package.name)) + palette.dim(f"  {kind}"), ""]
    for finding in share.own[:SHOWN_LIMIT]:
        lines += [*finding_text(finding, package, palette, finding.rule in explained), ""]
        explained.add(finding.rule)
    lines += _counted(share.own[SHOWN_LIMIT:])
    lines += [
        f"{count(n, 'finding')} in {plain(name)}: listed there"
        for name, n in share.elsewhere.items()
    ]
    lines += [f"settings: {plain(shortened(package.settings, MESSAGE_LIMIT))}"] * bool(
        package.settings
    )
    lines += suppressed_text(package.suppressed)
    lines += _inherited(package)
    lines += _not_checked(package.not_checked)
    lines += trial_text(package.trial, palette) if package.trial else []
    lines += _facts(package.facts)
    lines.append(_verdict(package, palette))
    return "\n".join(lines) + "\n"


def _profile(package: PackageReport) -> str:
    """Name the profile where it is not the usual one: what is checked may have chosen it."""
    return "" if package.profile == PackageReport.profile else f", profile {package.profile}"


def _counted(findings: Sequence[ReportedFinding]) -> Iterator[str]:
    """Count by rule what is too much to be read in full."""
    if findings:
        by_rule = Counter(each.rule for each in findings).most_common()
        rules = ", ".join(f"{number} {rule}" for rule, number in by_rule)
        yield f"… and {count(len(findings), 'more finding')}: {rules}; --format json lists all"


def _inherited(package: PackageReport) -> Iterator[str]:
    by_source: dict[str, list[str]] = {}
    for part in package.inherited:
        source = part.package + ("" if part.at_hand else " (not available)")
        by_source.setdefault(source, []).append(part.part)
    for source, parts in by_source.items():
        yield f"inherited from {plain(source)}: {plain(listed(parts))}"


def _not_checked(not_checked: Sequence[NotChecked]) -> Iterator[str]:
    by_reason: dict[tuple[str, bool], list[str]] = {}
    for each in not_checked:
        applies = each.cause is not Cause.NOT_APPLICABLE
        by_reason.setdefault((each.reason, applies), []).append(each.rule)
    for (reason, applies), rules in by_reason.items():
        said = plain(shortened(reason, MESSAGE_LIMIT))
        if applies:
            yield f"not checked: {', '.join(rules)}: {said}"
        else:
            yield f"not applicable: {count(len(rules), 'rule')}: {said}"


def _facts(facts: Mapping[str, object]) -> Iterator[str]:
    """Show what is known of the robot in one line."""
    if shown := [fact.phrase for fact in facts_in_words(facts)]:
        yield plain(", ".join(shown))


def _verdict(package: PackageReport, palette: Palette) -> str:
    return palette.verdict(package.verdict, f"{plain(package.name)}: {sentence(package)}")


def _skipped(each: NotOpened) -> str:
    return f"not opened: {plain(each.path)} {plain(each.reason)}\n"
