"""A suppression that names no known rule.

The suppression has no effect: the findings still count.

Fix: write ids or names of rules in the bracket: `subt-check: ignore[SEN005, GEO001] reason`.
`subt-check rules` lists them. Groups, such as `SEN`, cannot be suppressed by a comment.
Source: README, section "Suppress".
"""

from itertools import islice

from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.suppression.parts import Suppressions

_NAMED = 5
"""Greatest number of unknown names in the message; the rest is counted."""


@rule("CFG003", "unknown-suppressed-rule", Severity.WARNING, Concern.PAPERWORK)
def check(suppressions: Suppressions) -> Findings:
    """Report comments with words that are not rules, or without any."""
    names = dict.fromkeys(f"{entry.name!r}{entry.hint}" for entry in suppressions.unknown)
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    message = f"there is no rule {', nor '.join(islice(names, _NAMED))}{more}"
    for comment in dict.fromkeys(entry.comment for entry in suppressions.unknown):
        yield finding(comment.place, message, key="unknown names")
    for comment in suppressions.comments:
        if comment.fault:
            expected = "expected 'subt-check: ignore[RULE] reason'"
            yield finding(comment.place, f"the comment has no effect: {comment.fault}, {expected}")


GOOD = [
    "<!-- subt-check: ignore[KIN001, imprecise-angle] added at the start -->\n<link name='a'/>",
    "<!-- subt-check: see the README for how this is checked -->\n<link name='a'/>",
    "<!-- subt-check ignores[1] this -->\n<link name='a'/>",
]
BAD = [
    "<!-- subt-check: ignore[KIN01] added at the start -->  <!-- ^ CFG003 -->\n<link name='a'/>",
    "<!-- subt-check: ignore KIN001 -->  <!-- ^ CFG003 -->\n<link name='a'/>",
    "<!-- subt-check ignore[KIN001] no colon -->  <!-- ^ CFG003 -->\n<link name='a'/>",
    {
        "launch/extra.rb": "x = 1 # subt-check: disable[KIN001] it is so\n",
        "@reported": ["launch/extra.rb:1"],
    },
]
