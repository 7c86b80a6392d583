"""What the tools of the server return; nothing here knows the protocol."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Literal

from checker.base.errors import CheckerError
from checker.base.extras import PHYSICS
from checker.base.record import Record
from checker.base.words import shortened
from checker.cli.check.fix import fix_paths
from checker.cli.mcp.workspace import Workspace
from checker.cli.robot import FORMATS, facts_at
from checker.cli.rule import explanation
from checker.finding import Safety
from checker.fix.rounds import patch
from checker.pipeline import check_paths
from checker.report.figures import Row, rows_of
from checker.report.report import NotChecked, PackageReport, Report, ReportedFinding
from checker.report.robots import ReportedRobot, robots_of
from checker.report.summary import sentence
from checker.rulebook.discovery import all_rules

FINDINGS_LIMIT = 200
"""Findings of a package that are returned; the rest is counted."""
_PLACES_LIMIT = 10
_TEXT_LIMIT = 600
_NO_WRITING = (
    "apply is refused: the server only reads; start it with `subt-check mcp --write` to let it "
    "change files, or call fix without apply, which returns the diff"
)
RobotFormat = Literal["text", "json", "mermaid"]


class Tools(Record):
    """The tools of one server.

    Attributes:
        workspace: All paths are relative to its root, which is the current folder.
        writes: Whether `fix` may change files.
        dirty: Whether it may change files that have uncommitted changes in git.
    """

    workspace: Workspace
    writes: bool = False
    dirty: bool = False

    def check(self, path: str) -> dict[str, Any]:
        """Return verdict, findings and what was not checked of the packages at a path."""
        report = self._report(path, trial=False)
        return {"packages": [_package(each) for each in report.packages], **_not_opened(report)}

    def explain(self, rule: str) -> str:
        """Return the page of a rule, or the rules of a group."""
        return explanation(rule)

    def robot(self, path: str, form: RobotFormat = "text") -> str:
        """Return the facts of the robots of the packages at a path."""
        return FORMATS[form](facts_at(self.workspace.path(path), {}))

    def fix(self, path: str, *, unsafe: bool = False, apply: bool = False) -> dict[str, Any]:
        """Return the corrections of a path as a diff; write them if that is wanted and allowed."""
        where = self.workspace.path(path)
        if apply and not self.writes:
            raise CheckerError(_NO_WRITING)
        allowed = list(Safety) if unsafe else [Safety.SAFE]
        done = fix_paths([where], {}, allowed, write=apply, dirty=self.dirty)
        fixed = [each.fixed for each in done]
        return {
            "applied": apply,
            "diff": "".join(patch(each.fixed.files, _folder(each.shown)) for each in done),
            "corrects": [_short(it) for each in fixed for it in each.findings],
            "cannot_correct": [_short(it) for each in fixed for it in each.left],
            "needs_unsafe": [_short(it) for each in fixed for it in each.withheld],
            "in_other_packages": [_short(it) for each in fixed for it in each.elsewhere],
        }

    def trial(self, path: str) -> dict[str, Any]:
        """Return what was measured while the robots at a path drove, and its judgement."""
        PHYSICS.require_for("trial")
        report = self._report(path, trial=True)
        judging = {rule.id for rule in all_rules() if rule.judges}
        packages = [
            {
                "name": each.name,
                "path": each.path,
                "robots": [_driven(robot) for robot in robots_of(each)],
                "findings": [_finding(it) for it in each.findings if it.rule in judging],
                "not_checked": _not_checked(it for it in each.not_checked if it.rule in judging),
            }
            for each in report.packages
        ]
        return {"packages": packages, **_not_opened(report)}

    def _report(self, path: str, *, trial: bool) -> Report:
        where = self.workspace.path(path)
        report = check_paths([where], {"trial": trial})
        if not report.packages:
            reasons = [f"{item.path} {item.reason}" for item in report.not_opened]
            raise CheckerError("; ".join(reasons) or f"{path} contains no package")
        return report


def _folder(shown: str) -> str:
    return "" if shown == "." else shown


def _package(package: PackageReport) -> dict[str, Any]:
    found = package.findings
    more = {"more_findings": len(found) - FINDINGS_LIMIT} if len(found) > FINDINGS_LIMIT else {}
    return {
        "name": package.name,
        "path": package.path,
        "profile": package.profile,
        "verdict": str(package.verdict),
        "summary": str(sentence(package)),
        "findings": [_finding(each) for each in found[:FINDINGS_LIMIT]],
        **more,
        "suppressed": len(package.suppressed),
        "not_checked": _not_checked(package.not_checked),
    }


def _finding(found: ReportedFinding) -> dict[str, Any]:
    places = [f"{it.file}:{it.line}:{it.column}" for it in found.places[:_PLACES_LIMIT]]
    more = len(found.places) - len(places)
    return {
        **_short(found),
        "severity": str(found.severity),
        "places": [*places, f"and {more} more"] if more else places,
        "how": found.how,
        "fix": str(found.fix.safety) if found.fix is not None else "by hand",
    }


def _short(found: ReportedFinding) -> dict[str, Any]:
    message = shortened(found.message, _TEXT_LIMIT)
    return {"rule": found.rule, "name": found.name, "message": message}


def _not_checked(unseen: Iterable[NotChecked]) -> list[dict[str, Any]]:
    """Return what was not checked although it could be of use, by reason."""
    rules: dict[tuple[str, str], list[str]] = {}
    for each in unseen:
        if each.cause != "not_applicable":
            reason = shortened(each.reason, _TEXT_LIMIT)
            rules.setdefault((reason, str(each.cause)), []).append(each.rule)
    return [
        {"reason": reason, "cause": cause, "rules": names}
        for (reason, cause), names in rules.items()
    ]


def _not_opened(report: Report) -> dict[str, Any]:
    items = [f"{item.path} {item.reason}" for item in report.not_opened]
    return {"not_opened": items} if items else {}


def _driven(robot: ReportedRobot) -> dict[str, Any]:
    trial: Mapping[str, Any] = robot.trial or {}
    measures = map(_measure, rows_of(trial["measurements"])) if trial else ()
    return {
        "robot": robot.name,
        "verdict": str(robot.verdict) or "no trial",
        "drive": trial.get("drive", ""),
        "measures": list(measures),
        "notes": list(_notes(trial)),
    }


def _measure(row: Row) -> dict[str, str]:
    return {
        "measure": row.label,
        "value": row.value,
        "verdict": row.verdict,
        "limits": row.limits,
        "rule": row.rule,
    }


def _notes(trial: Mapping[str, Any]) -> Iterator[str]:
    yield from trial.get("notes", ())
    for repair in trial.get("repairs", ()):
        yield f"to make the trial possible: {repair['part']} {repair['what']}"
