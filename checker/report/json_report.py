"""The report as JSON (`report.schema.json` describes it)."""

from __future__ import annotations

import json
import re
from dataclasses import asdict
from typing import Any

from checker.finding import Edit, Place
from checker.report.report import SCHEMA_VERSION, PackageReport, Report, ReportedFinding

_UNPRINTABLE = re.compile(r"[\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")


def to_json(report: Report) -> str:
    """Return the report as JSON text; what would steer a terminal or is no character is escaped."""
    text = json.dumps(to_dict(report), indent=2, ensure_ascii=False) + "\n"
    return _UNPRINTABLE.sub(lambda found: f"\\u{ord(found[0]):04x}", text)


def to_dict(report: Report) -> dict[str, Any]:
    """Return the report as plain dictionaries and lists."""
    return {
        "schema_version": SCHEMA_VERSION,
        "tool": {"name": "subt-check", "versions": dict(report.versions)},
        "packages": [_package(package) for package in report.packages],
        "not_opened": [{"path": each.path, "reason": each.reason} for each in report.not_opened],
    }


def _package(package: PackageReport) -> dict[str, Any]:
    return {
        "name": package.name,
        "path": package.path,
        "kind": package.kind,
        "profile": package.profile,
        "verdict": str(package.verdict),
        "inherited": [asdict(part) for part in package.inherited],
        "findings": [_finding(each) for each in package.findings],
        "suppressed": [],
        "not_checked": [
            {"rule": each.rule, "reason": each.reason, "cause": str(each.cause)}
            for each in package.not_checked
        ],
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


def _place(place: Place) -> dict[str, Any]:
    return asdict(place)


def _edit(edit: Edit) -> dict[str, Any]:
    keys = ("file", "line", "column", "end_line", "end_column")
    return {key: getattr(edit.place, key) for key in keys} | {"replacement": edit.replacement}
