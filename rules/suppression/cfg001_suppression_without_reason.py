"""A suppression without a reason.

The suppression is ignored. Readers of the report need the reason to see why the finding does not
count.

Fix: write the reason after the bracket: `subt-check: ignore[SEN015] the device has 15 Hz`.
Source: docs/usage.md, section "Suppress".
"""

from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.suppression.parts import Suppressions


@rule("CFG001", "suppression-without-reason", Severity.WARNING, Concern.PAPERWORK)
def check(suppressions: Suppressions) -> Findings:
    """Report comments that name rules, but give no reason."""
    for comment in suppressions.comments:
        if comment.names and not comment.reason:
            names = ", ".join(comment.names)
            yield finding(
                comment.place, f"ignore[{names}] has no effect: write the reason after the bracket"
            )


GOOD = [
    "<!-- subt-check: ignore[SEN005] the device really has 15 Hz -->\n<link name='a'/>",
    "<!-- ignore[SEN005] -->\n<link name='a'/>",
]
BAD = [
    "<!-- subt-check: ignore[SEN005] --> <!-- ^ CFG001 -->\n<link name='a'/>",
    {
        "config/a.yaml": "gain: 1  # subt-check: ignore[ROS001, ROS002]\n",
        "@reported": ["config/a.yaml:1"],
    },
]
