"""What was not looked at and what was set aside, by reason."""

from __future__ import annotations

from collections.abc import Sequence

from checker.record import record
from checker.report.report import Cause, NotChecked, Suppressed
from checker.report.wording import plain, shortened

_TEXT_LIMIT = 600
SHOWN = 300
"""Entries of a list; what goes beyond is counted."""
_CAUSES = {
    Cause.CRASHED: "internal error",
    Cause.NOT_AT_HAND: "not available",
    Cause.SWITCHED_OFF: "switched off",
    Cause.NOT_APPLICABLE: "not applicable",
}
"""In words, what keeps a package from being ready first."""


@record()
class Reason:
    """A reason and the rules that did not look because of it."""

    cause: str
    reason: str
    rules: tuple[str, ...]


@record()
class SetAside:
    """A finding that does not count: what it says, where, and why it does not."""

    rule: str
    message: str
    where: str
    by: str
    reason: str


def reasons_of(not_checked: Sequence[NotChecked]) -> list[Reason]:
    """Join what has one reason; what keeps the package from being ready comes first."""
    found: dict[tuple[Cause, str], list[str]] = {}
    for each in not_checked:
        found.setdefault((each.cause, each.reason), []).append(each.rule)
    order = list(_CAUSES)
    ordered = sorted(found.items(), key=lambda item: order.index(item[0][0]))
    return [
        Reason(_CAUSES[cause], plain(shortened(reason, _TEXT_LIMIT)), tuple(dict.fromkeys(rules)))
        for (cause, reason), rules in ordered
    ]


def suppressed_of(suppressed: Sequence[Suppressed]) -> list[SetAside]:
    """Return what was set aside, as far as the page shows it."""
    return [
        SetAside(
            plain(each.finding.rule),
            plain(shortened(each.finding.message, _TEXT_LIMIT)),
            plain(str(each.finding.places[0])),
            str(each.by),
            plain(shortened(each.reason, _TEXT_LIMIT)),
        )
        for each in suppressed[:SHOWN]
    ]


def why_not_driven(not_checked: Sequence[NotChecked]) -> str:
    """Return why the rules on the trial did not look; empty where they say nothing."""
    reasons = (each.reason for each in not_checked if each.rule.startswith("TRI"))
    return plain(shortened(next(reasons, ""), _TEXT_LIMIT))
