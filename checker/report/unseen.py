"""Rules that were not checked, by the reason."""

from __future__ import annotations

import re
from collections.abc import Iterable

from checker.base.record import Record
from checker.base.words import count
from checker.report.report import Cause, NotChecked

_OF_FILE = re.compile(r"(\S+) (is in \S+, which is not available|is outside the workspace)")


class Unseen(Record):
    """Rules that were not checked for one reason."""

    reason: str
    cause: Cause
    rules: tuple[str, ...]


def by_reason(not_checked: Iterable[NotChecked]) -> list[Unseen]:
    """Join what has one reason; all files of a package that is not available are one.

    So are all that are outside the workspace.
    """
    joined: dict[tuple[str, Cause], list[NotChecked]] = {}
    for skipped in not_checked:
        of_file = _OF_FILE.fullmatch(skipped.reason)
        reason = of_file[2] if of_file else skipped.reason
        joined.setdefault((reason, skipped.cause), []).append(skipped)
    return [
        Unseen(_reason(several), cause, tuple(dict.fromkeys(it.rule for it in several)))
        for (_, cause), several in joined.items()
    ]


def _reason(several: list[NotChecked]) -> str:
    first = several[0].reason
    matches = [match for it in several if (match := _OF_FILE.fullmatch(it.reason))]
    others = len({match[1] for match in matches}) - 1
    if others < 1:
        return first
    file, why = matches[0].groups()
    return f"{file} and {count(others, 'more file')} {why.replace('is', 'are', 1)}"
