"""Fixing a package in rounds, in memory: apply compatible fixes, check again, repeat."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import unified_diff
from itertools import pairwise

from msgspec.structs import replace

from checker.base.record import Record
from checker.base.words import plain
from checker.finding import Edit, Fix, Safety, Severity
from checker.package.package import Package
from checker.report.report import ReportedFinding
from checker.source.text import SourceText

# Edits of one text: which of them go together, and the result.


@dataclass(frozen=True, order=True)
class Stretch:
    """Characters `start` up to, not including, `end`, and the new text."""

    start: int
    end: int
    replacement: str

    def collides(self, other: Stretch) -> bool:
        """Return whether only one can be replaced; two insertions at one point have no order."""
        if self.start == other.start:
            return True
        first, second = sorted((self, other))
        return second.start < first.end


@dataclass
class EditedText:
    """A text and the edits gathered for it.

    Attributes:
        stretches: The stretches in the order of the text; none collides with another.
    """

    source: SourceText
    stretches: list[Stretch] = field(default_factory=list)

    def stretch(self, edit: Edit) -> Stretch | None:
        """Return what an edit replaces; None if the text differs from what it expects."""
        offsets = self.source.stretch_of(edit)
        return None if offsets is None else Stretch(*offsets, edit.replacement)

    def accepts(self, stretch: Stretch) -> bool:
        """Return whether a stretch is free, or already becomes the same text."""
        beside = self._neighbours(stretch)
        return stretch in beside or not any(map(stretch.collides, beside))

    def add(self, stretch: Stretch) -> None:
        """Take a stretch that the text accepts among the edits."""
        if stretch not in self._neighbours(stretch):
            insort(self.stretches, stretch)

    def _neighbours(self, stretch: Stretch) -> list[Stretch]:
        """Return the stretches in front of and behind a place; one that is further off is free."""
        behind = bisect_left(self.stretches, stretch)
        return self.stretches[max(behind - 1, 0) : behind + 1]

    @property
    def result(self) -> str:
        """The text after all edits."""
        pieces, end = [], 0
        for stretch in self.stretches:
            pieces += [self.source.text[end : stretch.start], stretch.replacement]
            end = stretch.end
        return "".join((*pieces, self.source.text[end:]))


def take(fix: Fix, texts: Mapping[str, EditedText]) -> bool:
    """Add all edits of a fix to the texts, or none; return whether they could be added."""
    stretches: list[tuple[EditedText, Stretch]] = []
    for edit in fix.edits:
        text = texts.get(edit.place.file)
        stretch = text.stretch(edit) if text is not None else None
        if text is None or stretch is None or not text.accepts(stretch):
            return False
        stretches.append((text, stretch))
    if _collide(stretches):
        return False
    for text, stretch in stretches:
        text.add(stretch)
    return True


def _collide(stretches: Iterable[tuple[EditedText, Stretch]]) -> bool:
    """Return whether edits of one fix contradict each other."""
    ordered = sorted({(text.source.file, stretch) for text, stretch in stretches})
    return any(a[0] == b[0] and a[1].collides(b[1]) for a, b in pairwise(ordered))


MAX_ROUNDS = 10

FindingsOf = Callable[[Package], tuple[ReportedFinding, ...]]
"""Checks a package and returns its findings."""


class FixedFile(Record):
    """A file of the package before and after."""

    path: str
    before: SourceText
    after: str


class Fixed(Record):
    """Result of fixing.

    Attributes:
        files: The files that change.
        findings: What was fixed, in order.
        left: Findings whose fix was allowed and could not be made.
        elsewhere: Findings whose fix was allowed, in files that belong to other packages.
        withheld: Findings whose fix changes behaviour and was not requested.
        rounds: The number of rounds of edits.
        unproven: Findings whose fix was left out, because more would be wrong after it.
    """

    files: tuple[FixedFile, ...]
    findings: tuple[ReportedFinding, ...]
    left: tuple[ReportedFinding, ...]
    elsewhere: tuple[ReportedFinding, ...]
    withheld: tuple[ReportedFinding, ...]
    rounds: int
    unproven: tuple[ReportedFinding, ...] = ()


def fix_package(
    package: Package,
    judge: FindingsOf,
    allowed: Collection[Safety],
    prove: FindingsOf | None = None,
) -> Fixed:
    """Apply fixes until nothing changes; nothing is written.

    Args:
        package: The package as it is on disk.
        judge: Checks the package as edited so far.
        allowed: Fixes that may be made.
        prove: Checks it more thoroughly; then a fix is kept only if no rule reports more errors
            after it.
    """
    edited: dict[str, SourceText] = {}
    fixed: list[ReportedFinding] = []
    findings: tuple[ReportedFinding, ...] = ()
    fixable: list[ReportedFinding] = []
    unproven: dict[str, ReportedFinding] = {}
    for rounds in range(MAX_ROUNDS + 1):
        findings = judge(package.with_texts(edited))
        fixable = [
            finding
            for finding in findings
            if finding.fix and finding.fix.safety in allowed and finding.fingerprint not in unproven
        ]
        if rounds == MAX_ROUNDS:
            break
        if prove is None:
            applied = _round(fixable, package, edited)
        else:
            applied = _proven_round(fixable, package, edited, prove)
            unproven |= {each.fingerprint: each for each in fixable if each not in applied}
        fixed += applied
        if not applied:
            break
    changes = tuple(_changes(package, edited))
    # Fixes that contradict each other, as of wheels that share a macro, may end where they began.
    done = {reported.fingerprint: reported for reported in fixed} if changes else {}
    return Fixed(
        changes,
        tuple(done.values()),
        tuple(reported for reported in fixable if not _elsewhere(reported)),
        tuple(reported for reported in fixable if _elsewhere(reported)),
        tuple(finding for finding in findings if finding.fix and finding.fix.safety not in allowed),
        rounds,
        tuple(unproven.values()),
    )


def _proven_round(
    fixable: Sequence[ReportedFinding],
    package: Package,
    edited: dict[str, SourceText],
    prove: FindingsOf,
) -> list[ReportedFinding]:
    """Make the edits after which nothing is worse: all together, else one by one."""
    before = _errors(prove(package.with_texts(edited))) if fixable else Counter()
    kept: list[ReportedFinding] = []
    for attempt in (fixable, *([each] for each in fixable)):
        texts = dict(edited)
        applied = _round(attempt, package, texts)
        after = _errors(prove(package.with_texts(texts))) if applied else before
        if applied and not after - before:
            edited |= texts
            before, kept = after, kept + applied
            if attempt is fixable:
                break
    return kept


def _errors(findings: Iterable[ReportedFinding]) -> Counter[str]:
    """Count the places of errors by rule; related ones are none."""
    return Counter(
        finding.rule
        for finding in findings
        if finding.severity is Severity.ERROR
        for place in finding.places
        if not place.note
    )


def one_round(
    package: Package, findings: Sequence[ReportedFinding], allowed: Collection[Safety]
) -> tuple[FixedFile, ...]:
    """Return the result of the fixes of these findings, as far as they are compatible."""
    edited: dict[str, SourceText] = {}
    _round(
        [finding for finding in findings if finding.fix and finding.fix.safety in allowed],
        package,
        edited,
    )
    return tuple(_changes(package, edited))


def _elsewhere(finding: ReportedFinding) -> bool:
    edits = finding.fix.edits if finding.fix else ()
    return any(edit.place.file.startswith("../") for edit in edits)


def _round(
    findings: Sequence[ReportedFinding], package: Package, edited: dict[str, SourceText]
) -> list[ReportedFinding]:
    """Make the edits that go together, and return the findings that they correct."""
    paths = {edit.place.file for finding in findings if finding.fix for edit in finding.fix.edits}
    sources = {path: _own_text(package, path, edited) for path in sorted(paths)}
    texts = {path: EditedText(source) for path, source in sources.items() if source is not None}
    applied = [finding for finding in findings if finding.fix and take(finding.fix, texts)]
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


# What fixing changes, as a patch that `git apply` and `patch -p1` understand.


_NO_NEWLINE = "\\ No newline at end of file\n"


def patch(files: Iterable[FixedFile], folder: str = "") -> str:
    """Return the changes as a unified diff.

    Args:
        files: What changes; those whose names would break the patch are left out.
        folder: What to put in front of the paths, such as the package's name.
    """
    named = (file for file in files if plain(file.path) == file.path)
    return "".join(line for file in named for line in _diff(file, folder))


def _diff(file: FixedFile, folder: str) -> Iterator[str]:
    path = f"{folder}/{file.path}" if folder else file.path
    before = _lines(file.before.text)
    after = _lines(file.after)
    for line in unified_diff(before, after, f"a/{path}", f"b/{path}"):
        yield line if line.endswith("\n") else f"{line}\n{_NO_NEWLINE}"


def _lines(text: str) -> list[str]:
    # Not splitlines(): a form feed or a lone carriage return ends no line for patch.
    lines = text.split("\n")
    return [f"{line}\n" for line in lines[:-1]] + [line for line in lines[-1:] if line]
