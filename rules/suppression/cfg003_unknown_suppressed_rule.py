"""A suppression that names no rule.

It has no effect, although it reads as if it had.

Fix: write ids or names of rules into the bracket: `subt-check: ignore[SEN005, GEO001] reason`.
`subt-check rules` lists them. Groups, such as `SEN`, cannot be suppressed by a comment.
Source: README, section "Suppress".
"""

from checker.rule import Findings, Severity, finding, rule
from checker.suppression.parts import Suppressions


@rule("CFG003", "unknown-suppressed-rule", Severity.WARNING)
def check(suppressions: Suppressions) -> Findings:
    """Report comments that name other words than rules, or nothing."""
    for each in suppressions.unknown:
        yield finding(each.comment.place, f"there is no rule {each.name!r}{each.hint}")
    for comment in suppressions.comments:
        if not comment.names:
            yield finding(
                comment.place, "comment has no effect, expected 'ignore[RULE] reason' in it"
            )


GOOD = [
    "<!-- subt-check: ignore[KIN001, imprecise-angle] added at the start -->\n<link name='a'/>",
    "<!-- subt-check: see the README for how this is checked -->\n<link name='a'/>",
]
BAD = [
    "<!-- subt-check: ignore[KIN01] added at the start -->  <!-- ^ CFG003 -->\n<link name='a'/>",
    "<!-- subt-check: ignore KIN001 -->  <!-- ^ CFG003 -->\n<link name='a'/>",
    {
        "launch/extra.rb": "x = 1 # subt-check: disable[KIN001] it is so\n",
        "@reported": ["launch/extra.rb:1"],
    },
]
