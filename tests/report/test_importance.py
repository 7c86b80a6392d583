"""Order in which faults are corrected."""

from __future__ import annotations

from checker.finding import Concern, Place, Severity
from checker.report.importance import importance
from checker.report.report import ReportedFinding


def _error(rule: str, concern: Concern = Concern.ROBOT) -> ReportedFinding:
    return ReportedFinding(rule, "name", Severity.ERROR, concern, "x", "0" * 16, (Place("a.urdf"),))


def test_what_ends_a_node_comes_before_what_only_makes_it_move_badly() -> None:
    rules = ("INE006", "WIR007", "PKG006", "R2C005", "REF002")
    errors = [
        _error(rule, Concern.PAPERWORK if rule == "PKG006" else Concern.ROBOT) for rule in rules
    ]
    found = [it.rule for it in sorted(errors, key=importance)]
    assert found == ["REF002", "R2C005", "WIR007", "INE006", "PKG006"]
