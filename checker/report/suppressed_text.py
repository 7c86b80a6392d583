"""What was found and does not count, for a person at a terminal: by rule and reason."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from checker.report.report import IN_BASELINE, Suppressed, SuppressedBy
from checker.report.wording import count, plain, shortened

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


def _words(each: Suppressed) -> str:
    """Say by what and why a finding does not count; what the baseline holds is one heap."""
    if each.reason == IN_BASELINE:
        return f"by {_WHO[each.by]}"
    reason = plain(shortened(each.reason, _REASON_LIMIT))
    return f"of {each.finding.rule} by {_WHO[each.by]}: {reason}"
