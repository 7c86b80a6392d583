"""The report for a person at a terminal."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping, Sequence

from checker.finding import Place, Severity
from checker.report.palette import Palette
from checker.report.report import (
    Cause,
    NotChecked,
    PackageReport,
    Report,
    ReportedFinding,
    VerdictKind,
)
from checker.report.wording import count, listed, plain

MORE_PLACES = 3
"""So many places of a repeated fault are named; the rest is counted."""

MESSAGE_LIMIT = 600
SNIPPET_WIDTH = 160


def to_text(report: Report, palette: Palette) -> str:
    """Return the whole report."""
    checked = {package.name for package in report.packages}
    blocks = [_package(package, checked, palette) for package in report.packages]
    if len(report.packages) > 1:
        blocks.append(_summary(report, palette))
    return "\n".join(blocks)


def _package(package: PackageReport, checked: set[str], palette: Palette) -> str:
    own, elsewhere = _split_by_owner(package, checked)
    lines = [palette.bold(plain(package.name)) + palette.dim(f"  {package.kind}"), ""]
    explained: set[str] = set()
    for finding in own:
        lines += [*_finding(finding, package, palette, finding.rule in explained), ""]
        explained.add(finding.rule)
    lines += [f"{count(n, 'finding')} in {name}: see there" for name, n in elsewhere.items()]
    lines += _inherited(package)
    lines += _not_checked(package.not_checked)
    lines += _facts(package.facts)
    lines.append(_verdict(package, palette))
    return "\n".join(lines) + "\n"


def _split_by_owner(
    package: PackageReport, checked: set[str]
) -> tuple[list[ReportedFinding], Mapping[str, int]]:
    """Set apart the findings in another package's files that this run reports there."""
    own: list[ReportedFinding] = []
    elsewhere: dict[str, int] = {}
    for finding in package.findings:
        owner = finding.places[0].file.split("/")[1] if _is_foreign(finding.places[0]) else ""
        if owner in checked:
            elsewhere[owner] = elsewhere.get(owner, 0) + 1
        else:
            own.append(finding)
    return own, elsewhere


def _is_foreign(place: Place) -> bool:
    return place.file.startswith("../")


def _finding(
    finding: ReportedFinding, package: PackageReport, palette: Palette, explained: bool
) -> Iterator[str]:
    """Show a finding; why and how are said where its rule comes up first."""
    place = finding.places[0]
    message = plain(finding.message)[:MESSAGE_LIMIT]
    severity = palette.severity(finding.severity)
    yield f"{_where(place, package)} {severity} {finding.rule} {finding.name}: {message}"
    if finding.severity is Severity.INFO:
        return
    yield from _frame(place, palette)
    notes = [p for p in finding.places[1:] if p.note]
    repeats = [p for p in finding.places[1:] if not p.note]
    for other in notes[:MORE_PLACES]:
        yield f"    {_where(other, package)}: {plain(other.note)}"
    if repeats:
        named = [f"{plain(p.file)}:{p.line}" for p in repeats[:MORE_PLACES]]
        more = len(repeats) - len(named)
        yield f"    also {', '.join(named)}" + (f" and {count(more, 'more place')}" if more else "")
    if explained:
        return
    if finding.why:
        yield f"    why: {finding.why}"
    if finding.how:
        yield f"    fix: {finding.how}"
    yield palette.dim(f"    {finding.help}")


def _where(place: Place, package: PackageReport) -> str:
    path = posixpath.normpath(posixpath.join(package.path, place.file or "."))
    return f"{plain(path)}:{place.line}:{place.column}"


def _frame(place: Place, palette: Palette) -> Iterator[str]:
    """Show the source line with a caret below the marked text."""
    if not place.snippet.strip():
        return
    column = place.column - 1
    end = place.end_column - 1 if place.end_line == place.line else len(place.snippet)
    start = max(0, min(column - 40, len(place.snippet) - SNIPPET_WIDTH))
    shown = plain(place.snippet.expandtabs(1))[start : start + SNIPPET_WIDTH]
    width = max(1, min(end, start + SNIPPET_WIDTH) - column)
    number = str(place.line)
    yield f"    {palette.dim(number + ' |')} {shown.rstrip()}"
    yield f"    {' ' * len(number)} {palette.dim('|')} {' ' * (column - start)}{'^' * width}"


def _inherited(package: PackageReport) -> Iterator[str]:
    by_source: dict[str, list[str]] = {}
    for part in package.inherited:
        source = part.package + ("" if part.at_hand else " (not at hand)")
        by_source.setdefault(source, []).append(part.part)
    for source, parts in by_source.items():
        yield f"inherited from {plain(source)}: {plain(listed(parts))}"


def _not_checked(not_checked: Sequence[NotChecked]) -> Iterator[str]:
    by_reason: dict[str, list[str]] = {}
    for each in not_checked:
        if each.cause is not Cause.NOT_APPLICABLE:
            by_reason.setdefault(each.reason, []).append(each.rule)
    for reason, rules in by_reason.items():
        yield f"not checked: {', '.join(rules)}: {plain(reason)}"


def _facts(facts: Mapping[str, object]) -> Iterator[str]:
    if not facts:
        return
    shown = []
    for name, value in facts.items():
        label, _, unit = name.partition("_kg")
        text = f"{value:g} kg" if isinstance(value, float) and name.endswith("_kg") else str(value)
        shown.append(f"{label} {text}" if unit == "" else f"{name} {text}")
    yield plain("; ".join(shown))


def _verdict(package: PackageReport, palette: Palette) -> str:
    errors, warnings = package.count(Severity.ERROR), package.count(Severity.WARNING)
    looks = f"{count(warnings, 'warning')} to look at" if warnings else ""
    match package.verdict:
        case VerdictKind.NOT_READY:
            said = [f"{count(errors, 'error')} to fix", looks]
            sentence = "Not ready: " + ", ".join(filter(None, said))
        case VerdictKind.INCOMPLETE:
            blind = len(package.blind_spots)
            reasons = listed(list(dict.fromkeys(n.reason for n in package.blind_spots))[:3])
            said = [f"{count(blind, 'rule')} could not look: {plain(reasons)}", looks]
            sentence = "Incomplete: no error, but " + ", ".join(filter(None, said))
        case _:
            sentence = "Ready" + (f": {looks}" if looks else ": nothing to fix")
    off = sum(n.cause is Cause.SWITCHED_OFF for n in package.not_checked)
    if off:
        sentence += f" ({count(off, 'rule')} switched off)"
    return palette.verdict(package.verdict, f"{plain(package.name)}: {sentence}")


def _summary(report: Report, palette: Palette) -> str:
    """One line a package, then the counts of all."""
    width = max(len(package.name) for package in report.packages)
    lines = []
    for package in report.packages:
        numbers = "  ".join(f"{package.count(level):4d} {level}" for level in Severity)
        verdict = palette.verdict(package.verdict, f"{package.verdict:<10}")
        lines.append(f"{plain(package.name):<{width}}  {verdict}  {numbers}")
    ready = sum(package.verdict is VerdictKind.READY for package in report.packages)
    lines.append(f"{count(len(report.packages), 'package')}, {ready} ready")
    return "\n".join(lines) + "\n"
