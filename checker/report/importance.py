"""Order of findings by importance."""

from __future__ import annotations

from collections.abc import Iterable

from checker.finding import Concern
from checker.report.report import ReportedFinding

_SOONEST = (
    *("SDF", "URD", "MJC", "REF", "MSH", "WLD", "LCH", "SPW", "PKG"),
    *("KIN", "PLG", "CTL", "R2C", "WIR", "DRV", "INE", "GEO", "TRI"),
    *("BRG", "SEN"),
)
"""Groups of rules in the order in which a robot starts: it is loaded, its controllers and nodes
start, it moves, and senses. What a trial shows comes last of what moves: it follows from faults of
the model."""
_LATER = (Concern.PAPERWORK, Concern.PORTABILITY)


def importance(finding: ReportedFinding) -> tuple[int, bool, int]:
    """Return a sort key; findings to correct first have the smallest."""
    group = finding.rule.rstrip("0123456789")
    rank = _SOONEST.index(group) if group in _SOONEST else len(_SOONEST)
    return finding.severity.rank, finding.concern in _LATER, rank


def by_rule(findings: Iterable[ReportedFinding]) -> list[list[ReportedFinding]]:
    """Return findings by severity and rule, those to correct first in front."""
    groups: dict[tuple[int, str], list[ReportedFinding]] = {}
    for finding in sorted(findings, key=importance):
        groups.setdefault((finding.severity.rank, finding.rule), []).append(finding)
    return list(groups.values())
