"""Findings as the page shows them: by rule, the gravest first, as many as one can read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from checker.finding import Place, Severity
from checker.record import record
from checker.report.html.frame import Change, Frame, changes_of, frame_of
from checker.report.report import ReportedFinding
from checker.report.wording import plain, shortened

MOST_OF_A_RULE = 40
"""Findings of one rule that are shown in full."""
MOST = 600
"""Findings that are shown in full; a page with more of them is read by nobody."""
_PLACES_SHOWN = 8
_TEXT_LIMIT = 600


@record()
class Spot:
    """A place, ready to be shown.

    Attributes:
        where: `model.sdf:12:3`; the folder has no line.
        element: Path of the XML element, by which the 3D view knows the part.
    """

    where: str
    note: str
    element: str


@record()
class ShownFinding:
    """One finding.

    Attributes:
        anchor: By which a link leads to it.
        others: Further places; `more` are not shown.
        elements: Of all places, the main one first: one of them may be a part of the robot.
    """

    anchor: str
    message: str
    spot: Spot
    frame: Frame | None
    others: tuple[Spot, ...]
    more: int
    elements: tuple[str, ...]
    safety: str
    changes: tuple[Change, ...]


@record()
class RuleGroup:
    """The findings of one rule and severity.

    Attributes:
        hidden: How many are not shown.
    """

    severity: str
    rule: str
    name: str
    why: str
    how: str
    findings: tuple[ShownFinding, ...]
    hidden: int


def groups_of(findings: Sequence[ReportedFinding]) -> list[RuleGroup]:
    """Return findings by severity and rule, in the order of each rule's first finding."""
    by_rule: dict[tuple[Severity, str], list[ReportedFinding]] = {}
    for each in findings:
        by_rule.setdefault((each.severity, each.rule), []).append(each)
    room = MOST
    groups = []
    for (severity, _), found in by_rule.items():
        shown = found[: min(MOST_OF_A_RULE, room)]
        room -= len(shown)
        first = found[0]
        groups.append(
            RuleGroup(
                str(severity), plain(first.rule), plain(first.name), plain(first.why),
                plain(first.how), tuple(_shown(each) for each in shown),
                len(found) - len(shown),
            )
        )  # fmt: skip
    return groups


def _shown(found: ReportedFinding) -> ShownFinding:
    main, *others = found.places
    return ShownFinding(
        anchor=f"f-{found.fingerprint}",
        message=plain(shortened(found.message, _TEXT_LIMIT)),
        spot=_spot(main),
        frame=frame_of(main),
        others=tuple(_spot(place) for place in others[:_PLACES_SHOWN]),
        more=max(0, len(others) - _PLACES_SHOWN),
        elements=tuple(_elements(found.places)),
        safety=str(found.fix.safety) if found.fix else "",
        changes=tuple(changes_of(found.fix)) if found.fix else (),
    )


def _spot(place: Place) -> Spot:
    where = f"{place.file}:{place.line}:{place.column}" if place.file else "the package's folder"
    return Spot(plain(where), plain(shortened(place.note, _TEXT_LIMIT)), plain(place.element))


def _elements(places: Sequence[Place]) -> Iterator[str]:
    """Yield paths of elements of the model; those of other files name nothing that is seen."""
    seen = (place.element for place in places[: _PLACES_SHOWN + 1])
    yield from dict.fromkeys(plain(element) for element in seen if element)
