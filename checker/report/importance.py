"""Order of findings by importance."""

from __future__ import annotations

from checker.finding import Concern
from checker.report.report import ReportedFinding

_SOONEST = ("SDF", "URD", "KIN", "REF", "MSH", "INE", "GEO", "TRI")
"""Groups of rules in the order in which a simulator fails: reading, joining, loading, weighing.
What a trial shows comes last: it follows from faults of the model."""


def importance(finding: ReportedFinding) -> tuple[int, int, int]:
    """Return a sort key; findings to correct first have the smallest."""
    group = finding.rule.rstrip("0123456789")
    rank = _SOONEST.index(group) if group in _SOONEST else len(_SOONEST)
    return finding.severity.rank, list(Concern).index(finding.concern), rank
