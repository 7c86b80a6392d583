"""Findings as the page shows them: the most severe first, up to a limit."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from itertools import islice

from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.finding import Concern, Fix, Place, Severity
from checker.report.corrected import corrected_lines
from checker.report.report import ReportedFinding

# A line of source with the fault marked, and what a fix makes of it.


WIDTH = 400
"""Characters of a line that are shown."""
_LEAD = 120
"""Greatest number of characters in front of the mark."""
_EDITS_SHOWN = 20
_LINES_SHOWN = 20


class Frame(Record):
    """A line of source in three parts; the middle one has the fault."""

    line: int
    before: str
    marked: str
    after: str


class Change(Record):
    """Change of a line, or of a longer stretch, line by line."""

    file: str
    line: int
    removed: tuple[str, ...]
    added: tuple[str, ...]


def frame_of(place: Place) -> Frame | None:
    """Return the line of a place; None if it is blank or not known."""
    text = plain(place.snippet.expandtabs(1))
    if not text.strip() or place.column > len(text):
        return None
    start = place.column - 1
    end = place.end_column - 1 if place.end_line == place.line else len(text)
    end = max(end, start)
    indent = min(len(text) - len(text.lstrip()), start)
    first = max(indent, start - _LEAD)
    before = ("…" if first > indent else "") + text[first:start]
    marked = shortened(text[start:end], WIDTH)
    return Frame(place.line, before, marked, shortened(text[end:], WIDTH).rstrip())


def changes_of(fix: Fix) -> Iterator[Change]:
    """Yield what a fix changes, line by line; a long one is cut."""
    for it in islice(corrected_lines(fix), _EDITS_SHOWN):
        yield Change(plain(it.file), it.line, _shown_lines(it.before), _shown_lines(it.after))


def _shown_lines(text: str) -> tuple[str, ...]:
    lines = [shortened(plain(line.expandtabs(2)), WIDTH) for line in text.split("\n")]
    if len(lines) > _LINES_SHOWN:
        lines = [*lines[:_LINES_SHOWN], f"… {len(lines) - _LINES_SHOWN} more lines"]
    return tuple(lines) if text.strip() else ()


MOST_OF_A_RULE = 40
"""Findings of one rule and severity that are shown in full."""
MOST = 600
"""Greatest number of findings shown in full."""
_PLACES_SHOWN = 8
_TEXT_LIMIT = 600
_SHORT_PATCH = 8
"""Lines of a patch that is not folded."""


class Spot(Record):
    """A place, ready to be shown.

    Attributes:
        where: `model.sdf:12:3`; the folder has no line.
        element: Path of the XML element, by which the 3D view knows the part.
    """

    where: str
    note: str
    element: str


class ShownFinding(Record):
    """One finding.

    Attributes:
        anchor: The anchor that links to it.
        others: Further places; `more` are not shown.
        also: Ids of other rules that report the same fault.
        elements: The elements of all places, the main one first: one of them may be a part of the
            robot.
    """

    anchor: str
    severity: str
    concern: str
    rule: str
    name: str
    message: str
    why: str
    how: str
    spot: Spot
    frame: Frame | None
    others: tuple[Spot, ...]
    more: int
    elements: tuple[str, ...]
    safety: str
    also: tuple[str, ...]
    changes: tuple[Change, ...]

    @property
    def is_short(self) -> bool:
        """True if its patch is short enough to read at a glance."""
        return sum(len(each.removed) + len(each.added) for each in self.changes) <= _SHORT_PATCH


class Grade(Record):
    """The findings of one severity.

    Attributes:
        total: The number of findings.
        hidden: The number of those not shown.
    """

    severity: str
    total: int
    findings: tuple[ShownFinding, ...]
    hidden: int


class RulePage(Record):
    """Part of a rule's page that the report shows for a rule with findings."""

    rule: str
    name: str
    title: str
    why: str
    how: str
    source: str
    findings: int


def in_order(findings: Sequence[ReportedFinding]) -> list[ReportedFinding]:
    """Return findings by severity and concern, then by place."""

    def key(finding: ReportedFinding) -> tuple[int, int, str, int, int, str]:
        place = finding.places[0]
        concern = list(Concern).index(finding.concern)
        grade = finding.severity.rank, concern
        return *grade, place.file, place.line, place.column, finding.rule

    return sorted(findings, key=key)


def grades_of(findings: Sequence[ReportedFinding], unseen: Collection[str] = ()) -> list[Grade]:
    """Return findings by severity, each in order.

    Args:
        findings: The findings of a package.
        unseen: Files of robots that the 3D view does not show.
    """
    by_severity = {severity: list[ReportedFinding]() for severity in Severity}
    for finding in in_order(findings):
        by_severity[finding.severity].append(finding)
    room = MOST
    grades = []
    for severity, own in by_severity.items():
        of_rule = Counter[str]()
        shown: list[ShownFinding] = []
        for finding in own:
            of_rule[finding.rule] += 1
            if len(shown) < room and of_rule[finding.rule] <= MOST_OF_A_RULE:
                shown.append(_shown_finding(finding, unseen))
        room -= len(shown)
        if own:
            grades.append(Grade(str(severity), len(own), tuple(shown), len(own) - len(shown)))
    return grades


def rule_pages(findings: Sequence[ReportedFinding]) -> list[RulePage]:
    """Return what is stated about each rule that found something, by its id."""
    number = Counter(finding.rule for finding in findings)
    firsts = {finding.rule: finding for finding in reversed(findings)}
    return [
        RulePage(
            plain(rule), plain(first.name), plain(first.title), plain(first.why), plain(first.how),
            plain(first.source), number[rule],
        )
        for rule, first in sorted(firsts.items())
    ]  # fmt: skip


def _shown_finding(reported: ReportedFinding, unseen: Collection[str]) -> ShownFinding:
    main, *others = reported.places
    return ShownFinding(
        anchor=anchor_of(reported),
        severity=str(reported.severity),
        concern=str(reported.concern),
        rule=plain(reported.rule),
        name=plain(reported.name),
        why=plain(reported.why),
        how=plain(reported.how),
        message=plain(shortened(reported.message, _TEXT_LIMIT)),
        spot=_spot(main),
        frame=frame_of(main),
        others=tuple(_spot(place) for place in others[:_PLACES_SHOWN]),
        more=max(0, len(others) - _PLACES_SHOWN),
        elements=tuple(_elements(reported.places, unseen)),
        safety=str(reported.fix.safety) if reported.fix else "",
        also=tuple(map(plain, reported.also)),
        changes=tuple(changes_of(reported.fix)) if reported.fix else (),
    )


def anchor_of(reported: ReportedFinding) -> str:
    """Return what follows `#` in the address of a finding; it stays while lines move."""
    return f"f-{reported.fingerprint}"


def _spot(place: Place) -> Spot:
    where = f"{place.file}:{place.line}:{place.column}" if place.file else "the package's folder"
    words = shortened(place.note or place.message, _TEXT_LIMIT)
    return Spot(plain(where), plain(words), plain(place.element))


def _elements(places: Sequence[Place], unseen: Collection[str]) -> Iterator[str]:
    """Yield paths of elements of the model; those of other files name nothing that is seen."""
    seen = (place.element for place in places[: _PLACES_SHOWN + 1] if place.file not in unseen)
    yield from dict.fromkeys(plain(element) for element in seen if element)
