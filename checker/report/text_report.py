"""The report for a person at a terminal."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from checker.base.words import count, listed, plain, shortened
from checker.finding import Severity
from checker.report.figures import Row, facts_in_words, rows_of
from checker.report.finding_text import MESSAGE_LIMIT, finding_text
from checker.report.ownership import Identity, owners, share_of
from checker.report.render_settings import Palette
from checker.report.report import (
    IN_BASELINE,
    USUAL_PROFILE,
    Cause,
    NotChecked,
    NotOpened,
    PackageReport,
    Report,
    ReportedFinding,
    Suppressed,
    SuppressedBy,
)
from checker.report.robots import robots_of
from checker.report.summary import sentence, summary_text

# The trial for a person at a terminal: one line for each figure that matters.


_TEXT_LIMIT = 300
_NOTES_SHOWN = 3


def trial_text(trial: Mapping[str, Any], palette: Palette) -> Iterator[str]:
    """Yield the lines of the table, and what was left out of the trial.

    Args:
        trial: As `PackageReport.trial` has it.
        palette: Colours.
    """
    if trial["refused"]:
        yield plain(f"trial: MuJoCo refuses the model: {_short(trial['refused'])}")
        return
    yield plain(f"trial: {_course(trial)}")
    if trial.get("not_driven"):
        yield plain(f"    not driven: {_short(trial['not_driven'])}")
    yield from _table([row for row in rows_of(trial["measurements"]) if row.matters], palette)
    for note in trial["notes"][:_NOTES_SHOWN]:
        yield plain(f"    note: {_short(note)}")
    if trial["repairs"]:
        repaired = count(len(trial["repairs"]), "repair")
        first = trial["repairs"][0]
        yield plain(f"    {repaired} to make the trial possible: {_short(_repair(first))}")


def _table(rows: Sequence[Row], palette: Palette) -> Iterator[str]:
    columns = [(row.label, row.value, row.verdict) for row in rows]
    widths = [max(map(len, column)) for column in zip(*columns, strict=True)]
    for row, texts in zip(rows, columns, strict=True):
        label, value, verdict = (
            plain(text).ljust(width) for text, width in zip(texts, widths, strict=True)
        )
        limits = row.limits if row.is_fault else ""
        yield f"    {label}  {value}  {_coloured(verdict, palette)}  {limits}".rstrip()


def _course(trial: Mapping[str, Any]) -> str:
    seconds = max((leg["end"] for leg in trial["course"]), default=0.0)
    version = trial["versions"].get("mujoco", "")
    return f"{trial['drive']}, {seconds:g} s in MuJoCo {version}".rstrip()


def _repair(repair: Mapping[str, Any]) -> str:
    return f"{repair['part']} {repair['what']}"


def _coloured(verdict: str, palette: Palette) -> str:
    word = verdict.strip()
    if word not in list(Severity):
        return verdict
    return palette.severity(Severity(word)) + verdict[len(word) :]


def _short(text: str) -> str:
    return shortened(text, _TEXT_LIMIT)


# What was found and does not count, for a person at a terminal: by rule and reason.


LINES_LIMIT = 20
_REASON_LIMIT = 300
_WHO = {
    SuppressedBy.COMMENT: "a comment",
    SuppressedBy.SETTINGS: "settings",
    SuppressedBy.BASELINE: "the baseline",
}


def suppressed_text(suppressed: Sequence[Suppressed]) -> Iterator[str]:
    """Yield a line for each rule and reason, those with the most findings first."""
    groups = Counter(map(_words, suppressed)).most_common()
    for words, number in groups[:LINES_LIMIT]:
        yield f"suppressed: {count(number, 'finding')} {words}"
    if rest := sum(number for _, number in groups[LINES_LIMIT:]):
        yield f"suppressed: {count(rest, 'more finding')}"


def _words(suppressed: Suppressed) -> str:
    """Say by what and why a finding does not count; what the baseline holds is one heap."""
    if suppressed.reason == IN_BASELINE:
        return f"by {_WHO[suppressed.by]}"
    reason = plain(shortened(suppressed.reason, _REASON_LIMIT))
    return f"of {suppressed.finding.rule} by {_WHO[suppressed.by]}: {reason}"


SHOWN_LIMIT = 200
"""Findings of one package that are shown in full; the rest is counted."""


def to_text(report: Report, palette: Palette) -> str:
    """Return the whole report."""
    owner_of = owners(report)
    explained: set[str] = set()
    blocks = [_package(package, owner_of, explained, palette) for package in report.packages]
    if len(report.packages) > 1:
        blocks.append(summary_text(report.packages, palette))
    if skipped := [_skipped(item) for item in report.not_opened if not item.failed]:
        blocks.append("".join(skipped))
    return "\n".join(blocks)


def _package(
    package: PackageReport,
    owner_of: Mapping[Identity, str],
    explained: set[str],
    palette: Palette,
) -> str:
    share = share_of(package, owner_of)
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
    lines += _robots(package, palette)
    lines.append(_verdict(package, palette))
    return "\n".join(lines) + "\n"


def _profile(package: PackageReport) -> str:
    """Name the profile where it is not the usual one: what is checked may have chosen it."""
    return "" if package.profile == USUAL_PROFILE else f", profile {package.profile}"


def _counted(findings: Sequence[ReportedFinding]) -> Iterator[str]:
    """Count by rule what is too much to be read in full."""
    if findings:
        by_rule = Counter(finding.rule for finding in findings).most_common()
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
    for skipped in not_checked:
        applies = skipped.cause is not Cause.NOT_APPLICABLE
        by_reason.setdefault((skipped.reason, applies), []).append(skipped.rule)
    for (reason, applies), rules in by_reason.items():
        text = plain(shortened(reason, MESSAGE_LIMIT))
        if applies:
            yield f"not checked: {', '.join(rules)}: {text}"
        else:
            yield f"not applicable: {count(len(rules), 'rule')}: {text}"


def _robots(package: PackageReport, palette: Palette) -> Iterator[str]:
    """Show the trial of the robot and what is known of it; of several robots, each in short."""
    robots = robots_of(package)
    for robot in robots:
        facts = [fact.phrase for fact in facts_in_words(robot.facts)]
        if len(robots) == 1 and robot.trial:
            yield from trial_text(robot.trial, palette)
        elif verdict := str(robot.verdict):
            facts.append(f"trial {shortened(verdict, _TEXT_LIMIT)}")
        if facts:
            yield plain(", ".join(facts))
        if len(robots) > 1 and robot.trial:
            rows = rows_of(robot.trial["measurements"])
            yield from _table([row for row in rows if row.is_fault], palette)


def _verdict(package: PackageReport, palette: Palette) -> str:
    return palette.verdict(package.verdict, f"{plain(package.name)}: {sentence(package)}")


def _skipped(item: NotOpened) -> str:
    return f"not opened: {plain(item.path)} {plain(item.reason)}\n"
