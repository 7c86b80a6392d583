"""The report as JSON (`report.schema.json` describes it)."""

from __future__ import annotations

import json
from typing import Any

from msgspec import to_builtins

from checker.finding import Edit, Place
from checker.report.report import (
    SCHEMA_VERSION,
    PackageReport,
    Report,
    ReportedFinding,
    Suppressed,
)


def to_json(report: Report) -> str:
    """Return the report as JSON text in plain ASCII: no terminal and no pipe can spoil it."""
    return json.dumps(to_dict(report), indent=2) + "\n"


def to_dict(report: Report) -> dict[str, Any]:
    """Return the report as plain dictionaries and lists."""
    return {
        "schema_version": SCHEMA_VERSION,
        "tool": {"name": "subt-check", "versions": dict(report.versions)},
        "packages": [_package(package) for package in report.packages],
        "not_opened": [to_builtins(each) for each in report.not_opened],
    }


def _package(package: PackageReport) -> dict[str, Any]:
    return {
        "name": package.name,
        "path": package.path,
        "kind": package.kind,
        "profile": package.profile,
        "settings": package.settings,
        "fail_on": str(package.fail_on),
        "verdict": str(package.verdict),
        "inherited": [to_builtins(part) for part in package.inherited],
        "findings": [_finding(each) for each in package.findings],
        "suppressed": [_suppressed(each) for each in package.suppressed],
        "not_checked": [
            {"rule": each.rule, "reason": each.reason, "cause": str(each.cause)}
            for each in package.not_checked
        ],
        "trial": package.trial,
        "facts": dict(package.facts),
        "timings": {stage: round(seconds, 4) for stage, seconds in package.timings.items()},
    }


def _finding(each: ReportedFinding) -> dict[str, Any]:
    finding: dict[str, Any] = {
        "rule": each.rule,
        "name": each.name,
        "severity": str(each.severity),
        "message": each.message,
        "fingerprint": each.fingerprint,
        "places": [_place(place) for place in each.places],
        "help": each.help,
    }
    if each.fix is not None:
        edits = [_edit(edit) for edit in each.fix.edits]
        finding["fix"] = {"safety": str(each.fix.safety), "edits": edits}
    return finding


def _suppressed(each: Suppressed) -> dict[str, Any]:
    return {
        "finding": _finding(each.finding),
        "by": str(each.by),
        "reason": each.reason,
        "place": None if each.place is None else _place(each.place),
    }


def _place(place: Place) -> dict[str, Any]:
    return to_builtins(place)


def _edit(edit: Edit) -> dict[str, Any]:
    keys = ("file", "line", "column", "end_line", "end_column")
    return {key: getattr(edit.place, key) for key in keys} | {"replacement": edit.replacement}
