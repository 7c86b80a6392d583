"""The report as JSON (`json_form` has its members), and read back, wherever it comes from.

Facts that are not in the JSON are missing afterwards: parts of the rules' pages (why, how, title,
source), the key of a finding, the text that an edit replaces, the rules that looked and found
nothing, the 3D view and the patch.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, cast

import msgspec

from checker.base.words import plain, shortened
from checker.finding import Edit, Fix, Place
from checker.report.json_form import (
    EditJson,
    FindingJson,
    FixJson,
    NotCheckedJson,
    NotOpenedJson,
    PackageJson,
    PlaceJson,
    RepeatJson,
    ReportJson,
    SuppressedJson,
    ToolJson,
    TrialJson,
)
from checker.report.report import (
    SCHEMA_VERSION,
    NotChecked,
    NotOpened,
    PackageReport,
    Repeat,
    Report,
    ReportedFinding,
    Suppressed,
)

SIZE_LIMIT = 128_000_000
"""Characters; 10 000 findings with the longest messages are 118 million, a trial is one million."""


class NoReport(ValueError):
    """A text that is no report of this version; it states why in a sentence without its dot."""


def to_json(report: Report) -> str:
    """Return the report as JSON text in plain ASCII: no terminal and no pipe can spoil it."""
    return json.dumps(to_dict(report), indent=2) + "\n"


def to_dict(report: Report) -> dict[str, Any]:
    """Return the report as plain dictionaries and lists."""
    members: dict[str, Any] = msgspec.to_builtins(
        ReportJson(
            SCHEMA_VERSION,
            ToolJson(versions=report.versions),
            tuple(map(_package_json, report.packages)),
            tuple(NotOpenedJson(item.path, item.reason, item.failed) for item in report.not_opened),
        )
    )
    return members


def _package_json(package: PackageReport) -> PackageJson:
    return PackageJson(
        name=package.name,
        path=package.path,
        kind=package.kind,
        profile=package.profile,
        target_reason=package.target_reason,
        settings=package.settings,
        fail_on=package.fail_on,
        verdict=package.verdict,
        inherited=package.inherited,
        findings=tuple(map(_finding_json, package.findings)),
        suppressed=tuple(map(_suppressed_json, package.suppressed)),
        not_checked=tuple(
            NotCheckedJson(each.rule, each.reason, each.cause, each.severity, each.concern)
            for each in package.not_checked
        ),
        trial=cast("TrialJson | None", package.trial),
        facts=package.facts,
        timings={stage: round(seconds, 4) for stage, seconds in package.timings.items()},
        other_robots=package.other_robots,
        other_trials=cast("tuple[TrialJson, ...]", package.other_trials),
        launched=package.launched,
    )


def _finding_json(reported: ReportedFinding) -> FindingJson:
    return FindingJson(
        rule=reported.rule,
        name=reported.name,
        severity=reported.severity,
        concern=reported.concern,
        message=reported.message,
        fingerprint=reported.fingerprint,
        places=tuple(map(_place_json, reported.places)),
        help=reported.help,
        fix=msgspec.UNSET if reported.fix is None else _fix_json(reported.fix),
        repeats=tuple(map(_repeat_json, reported.repeats)) or msgspec.UNSET,
    )


def _repeat_json(repeat: Repeat) -> RepeatJson:
    places = tuple(map(_place_json, repeat.places))
    return RepeatJson(repeat.rule, repeat.name, repeat.severity, repeat.message, places)


def _suppressed_json(suppressed: Suppressed) -> SuppressedJson:
    place = None if suppressed.place is None else _place_json(suppressed.place)
    return SuppressedJson(
        _finding_json(suppressed.finding), suppressed.by, suppressed.reason, place
    )


def _place_json(place: Place) -> PlaceJson:
    return PlaceJson(*msgspec.structs.astuple(place))


def _fix_json(fix: Fix) -> FixJson:
    return FixJson(fix.safety, tuple(map(_edit_json, fix.edits)))


def _edit_json(edit: Edit) -> EditJson:
    place = edit.place
    stretch = place.line, place.column, place.end_line, place.end_column
    return EditJson(place.file, *stretch, edit.replacement, place.snippet)


def report_from_json(text: str) -> Report:
    """Return the report that a JSON text contains; members of later versions are ignored.

    Raises:
        NoReport: It is no report, or of another version of the schema.
    """
    if len(text) > SIZE_LIMIT:
        raise NoReport(f"the report has more than {SIZE_LIMIT / 1e6:.0f} million characters")
    try:
        members = json.loads(text)
    except (ValueError, RecursionError):
        raise NoReport("the report is not JSON") from None
    version = members.get("schema_version") if isinstance(members, dict) else None
    if version != SCHEMA_VERSION:
        shown = shortened(plain(repr(version)), 40)
        raise NoReport(f"the report's schema_version is {shown}, expected '{SCHEMA_VERSION}'")
    try:
        return _report(msgspec.convert(members, ReportJson))
    except msgspec.ValidationError as error:
        problem = shortened(plain(str(error)), 200)
        raise NoReport(f"the report is invalid: {problem}") from None


def _report(read: ReportJson) -> Report:
    return Report(
        tuple(map(_package, read.packages)),
        read.tool.versions,
        tuple(NotOpened(item.path, item.reason, item.failed) for item in read.not_opened),
    )


def _package(read: PackageJson) -> PackageReport:
    return PackageReport(
        name=read.name,
        path=read.path,
        kind=read.kind,
        findings=tuple(map(_finding, read.findings)),
        not_checked=tuple(
            NotChecked(*msgspec.structs.astuple(unseen)) for unseen in read.not_checked
        ),
        inherited=read.inherited,
        facts=_facts(read.facts),
        other_robots=tuple(map(_facts, read.other_robots)),
        other_trials=cast("tuple[Mapping[str, Any], ...]", read.other_trials),
        launched=read.launched,
        timings=read.timings,
        profile=read.profile,
        target_reason=read.target_reason,
        fail_on=read.fail_on,
        settings=read.settings,
        trial=cast("Mapping[str, Any] | None", read.trial),
        suppressed=tuple(map(_suppressed, read.suppressed)),
    )


def _facts(read: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in read.items() if _is_fact(name, value)}


def _finding(read: FindingJson) -> ReportedFinding:
    return ReportedFinding(
        read.rule,
        read.name,
        read.severity,
        read.concern,
        read.message,
        read.fingerprint,
        tuple(map(_place, read.places)),
        None if isinstance(read.fix, msgspec.UnsetType) else _fix(read.fix),
        repeats=()
        if isinstance(read.repeats, msgspec.UnsetType)
        else tuple(map(_repeat, read.repeats)),
    )


def _repeat(read: RepeatJson) -> Repeat:
    places = tuple(map(_place, read.places))
    return Repeat(read.rule, read.name, read.severity, read.message, places)


def _suppressed(read: SuppressedJson) -> Suppressed:
    place = None if read.place is None else _place(read.place)
    return Suppressed(_finding(read.finding), read.by, read.reason, place)


def _place(read: PlaceJson) -> Place:
    return Place(*msgspec.structs.astuple(read))


def _fix(read: FixJson) -> Fix:
    return Fix(read.safety, tuple(map(_edit, read.edits)))


def _edit(read: EditJson) -> Edit:
    stretch = read.line, read.column, read.end_line, read.end_column
    place = Place(read.file, *stretch, snippet=read.snippet)
    return Edit(place, read.replacement, original="")


_TENSORS = ("inertia_kg_m2",)


def _is_fact(name: str, value: Any) -> bool:
    """Return whether a fact is a text, a number or a list; a later version may have others."""
    if name in _TENSORS:
        return isinstance(value, list) and all(map(_is_vector, value))
    return isinstance(value, str) or _is_number(value) or _is_vector(value)


def _is_vector(value: Any) -> bool:
    return isinstance(value, list) and all(map(_is_number, value))


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
