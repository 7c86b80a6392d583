"""The prices of specifications.md do not add up, or cost or mass is missing.

Organisers compare robots by what they cost and weigh. A total that is not the sum of its parts
shows that a part was added or left out.

Fix: correct the total or add the missing part. Write the cost in USD and the mass in kg, or say why
a figure cannot be given.
Source: the section "Cost and Scale" of the SubT template; one of fourteen itemised sheets
that were accepted does not add up.
"""

import re
from collections.abc import Iterator

from checker.model.specification.mass_cost_endurance import Price, prices
from checker.model.specification.sheet import Specification
from checker.rule import Concern, Finding, Findings, Severity, finding, rule

FEWEST_PARTS = 2
_EXPLAINED = re.compile(
    r"\bnot?\b[^.]{0,60}\b(?:available|known|sold|public|have|for sale|disclosed)|\bn/?a\b"
    r"|\bsame\b|\bunknown\b|\bconfidential\b|\bcustom\b",
    re.IGNORECASE,
)
_SAME_MASS = re.compile(
    r"\b(?:weigh\w*|mass)\b[^.]{0,80}\bsame\b|\bsame\b[^.]{0,80}\b(?:weigh|mass)", re.I
)


@rule("DOC007", "cost-and-mass", Severity.WARNING, Concern.PAPERWORK)
def check(specification: Specification, *, tolerance: float = 0.01) -> Findings:
    """Add up the parts, and look for a cost and a mass.

    Options:
        tolerance: Share of the larger figure by which the stated total and the sum of the parts may
            differ; more is reported.
    """
    section = specification.section("cost")
    if section is None or specification.says_nothing(section):
        return
    stated = prices(specification.stretch_of(section))
    yield from _sum(stated, tolerance)
    missing = []
    if not stated and not _EXPLAINED.search(section.text):
        missing.append("cost, in USD")
    if not (specification.masses or specification.unread) and not _SAME_MASS.search(section.text):
        missing.append("mass, in kg")
    if missing:
        yield finding(section, f"the section gives no {' and no '.join(missing)}")


def _sum(stated: tuple[Price, ...], tolerance: float) -> Iterator[Finding]:
    """Compare the sum of the parts with the stated total."""
    sums = [quantity for quantity in stated if quantity.is_sum]
    parts = [quantity for quantity in stated if quantity.is_part]
    clear = all(quantity.is_clear for quantity in (*sums, *parts))
    if len(sums) != 1 or len(parts) < FEWEST_PARTS or not clear:
        return
    added = sum(part.amount for part in parts)
    if abs(added - sums[0].amount) > tolerance * max(added, sums[0].amount):
        yield finding(
            sums[0],
            f"the parts cost {added:,.10g} together, but specifications.md states a total "
            f"of {sums[0].amount:,.10g}",
            related=[(part, "a part") for part in parts[:20]],
        )


_HEAD = "# Rover\n### Cost and Scale{mark}\n"
_MARK = " <!-- ^ DOC007 -->"
_MASS = "It weighs 25 kg.\n"


def _sheet(*lines: str, mark: str = "") -> dict[str, str]:
    return {"specifications.md": _HEAD.format(mark=mark) + "\n".join(lines) + "\n"}


GOOD = [
    _sheet("An estimated cost of USD 8,000. It weighs 3557 grams."),
    _sheet("* Base: $12,000", "* Sensors: $8,100 ($7,000 for one)", "* Total: ~ $20,100", _MASS),
    _sheet("A duplication cost of USD 700.", "$200 - D435", "$500  - Computer", _MASS),
    _sheet("A cost of USD 700.", "$200 - D435, each", "$100 - frame", _MASS),
    _sheet("A cost of USD 700.", "$100 - frame", "The frame was bought for $50.", _MASS),
    _sheet("Its cost is not publicly available. It weighs approximately 55 kg."),
    _sheet("It has the same cost as the X1. Its weight is the same as that of the X1."),
    {"specifications.md": "# Rover\n### Cost and Scale\n"},
]
BAD = [
    _sheet(f"A duplication cost of USD 8,600.{_MARK}", "$2500 - VLP-16", "$1800 - Frame", _MASS),
    _sheet("|a|USD 2,000|", "|b|USD 9,000|", f"| total | USD 10,000 | {_MARK}", _MASS),
    _sheet("An estimated cost of USD 8,000.", mark=_MARK),
    _sheet(_MASS, mark=_MARK),
]
