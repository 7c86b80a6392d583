"""Order of findings by importance."""

from __future__ import annotations

from checker.finding import Concern
from checker.report.report import ReportedFinding

_SOONEST = (
    *("SDF", "URD", "REF", "MSH", "WLD", "LCH", "SPW", "PKG"),
    *("KIN", "PLG", "CTL", "R2C", "DRV", "INE", "GEO", "TRI"),
    *("BRG", "WIR", "SEN"),
)
"""Groups of rules in the order in which a robot starts: it is loaded, moves, and senses. What a
trial shows comes last of what moves: it follows from faults of the model."""
_LATER = (Concern.PAPERWORK, Concern.PORTABILITY)


def importance(finding: ReportedFinding) -> tuple[int, bool, int]:
    """Return a sort key; findings to correct first have the smallest."""
    group = finding.rule.rstrip("0123456789")
    rank = _SOONEST.index(group) if group in _SOONEST else len(_SOONEST)
    return finding.severity.rank, finding.concern in _LATER, rank
