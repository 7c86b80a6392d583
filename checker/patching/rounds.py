"""Fixing a package in rounds, in memory: apply what goes together, check again, until it rests."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace

from checker.finding import Safety
from checker.package.package import Package
from checker.patching.edits import EditedText, take
from checker.record import record
from checker.report.report import ReportedFinding
from checker.source.text import SourceText

MAX_ROUNDS = 10

Judge = Callable[[Package], tuple[ReportedFinding, ...]]
"""Checks a package and returns its findings."""


@record()
class FixedFile:
    """A file of the package before and after."""

    path: str
    before: SourceText
    after: str


@record()
class Fixed:
    """What fixing comes to.

    Attributes:
        files: Those that change.
        findings: What was fixed, in order.
        left: Findings whose fix was allowed and could not be made.
        elsewhere: Findings whose fix was allowed, in files that belong to other packages.
        withheld: Findings whose fix changes behaviour and was not asked for.
        rounds: How often edits were made.
    """

    files: tuple[FixedFile, ...]
    findings: tuple[ReportedFinding, ...]
    left: tuple[ReportedFinding, ...]
    elsewhere: tuple[ReportedFinding, ...]
    withheld: tuple[ReportedFinding, ...]
    rounds: int


def fix_package(package: Package, judge: Judge, allowed: Collection[Safety]) -> Fixed:
    """Apply fixes until nothing changes; nothing is written.

    Args:
        package: As it is on disk.
        judge: Checks the package as edited so far.
        allowed: Fixes that may be made.
    """
    edited: dict[str, SourceText] = {}
    fixed: list[ReportedFinding] = []
    findings: tuple[ReportedFinding, ...] = ()
    wanted: list[ReportedFinding] = []
    for rounds in range(MAX_ROUNDS + 1):
        findings = judge(package.with_texts(edited))
        wanted = [each for each in findings if each.fix and each.fix.safety in allowed]
        applied = _round(wanted, package, edited) if rounds < MAX_ROUNDS else []
        fixed += applied
        if not applied:
            break
    return Fixed(
        tuple(_changes(package, edited)),
        tuple({each.fingerprint: each for each in fixed}.values()),
        tuple(each for each in wanted if not _elsewhere(each)),
        tuple(each for each in wanted if _elsewhere(each)),
        tuple(each for each in findings if each.fix and each.fix.safety not in allowed),
        rounds,
    )


def one_round(
    package: Package, findings: Sequence[ReportedFinding], allowed: Collection[Safety]
) -> tuple[FixedFile, ...]:
    """Return what the fixes of these findings come to, as far as they go together."""
    edited: dict[str, SourceText] = {}
    _round([each for each in findings if each.fix and each.fix.safety in allowed], package, edited)
    return tuple(_changes(package, edited))


def _elsewhere(finding: ReportedFinding) -> bool:
    edits = finding.fix.edits if finding.fix else ()
    return any(edit.place.file.startswith("../") for edit in edits)


def _round(
    findings: Sequence[ReportedFinding], package: Package, edited: dict[str, SourceText]
) -> list[ReportedFinding]:
    """Make the edits that go together, and return the findings that they mend."""
    paths = {edit.place.file for each in findings if each.fix for edit in each.fix.edits}
    sources = {path: _own_text(package, path, edited) for path in sorted(paths)}
    texts = {path: EditedText(source) for path, source in sources.items() if source is not None}
    applied = [each for each in findings if each.fix and take(each.fix, texts)]
    for path, text in texts.items():
        if text.stretches:
            edited[path] = replace(text.source, text=text.result)
    return applied


def _own_text(package: Package, path: str, edited: Mapping[str, SourceText]) -> SourceText | None:
    """Return a text file of the package itself; None for one that is not its own to change."""
    if path in edited:
        return edited[path]
    entry = package.index.find(path)
    if entry is None or entry.target_state is not None or not entry.is_file:
        return None
    source = package.read(path)
    return source if isinstance(source, SourceText) else None


def _changes(package: Package, edited: Mapping[str, SourceText]) -> Iterable[FixedFile]:
    for path, after in sorted(edited.items()):
        before = package.read(path)
        if isinstance(before, SourceText) and before.text != after.text:
            yield FixedFile(path, before, after.text)
