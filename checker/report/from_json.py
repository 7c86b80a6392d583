"""The JSON report (`json_report`) read back, wherever it comes from.

What the JSON does not hold is missing afterwards: what the rules' pages say (why, how, title,
source), the key of a finding, the text that an edit replaces, the rules that looked and found
nothing, the 3D view and the patch.
"""

from __future__ import annotations

import json
from typing import Any

from checker.base.words import plain, shortened
from checker.finding import Edit, Fix, Place
from checker.report.json_shapes import (
    EditJson,
    FindingJson,
    FixJson,
    PackageJson,
    PlaceJson,
    ReportJson,
    SuppressedJson,
)
from checker.report.reading import Unfit, read_as
from checker.report.report import (
    SCHEMA_VERSION,
    NotChecked,
    NotOpened,
    PackageReport,
    Report,
    ReportedFinding,
    Suppressed,
)

SIZE_LIMIT = 128_000_000
"""Characters; 10 000 findings with the longest messages are 118 million, a trial is one million."""


class NoReport(ValueError):
    """A text that is no report of this version; it says why in a sentence without its dot."""


def report_from_json(text: str) -> Report:
    """Return the report that a JSON text tells of; members of later versions are passed over.

    Raises:
        NoReport: It is no report, or of another version of the schema.
    """
    if len(text) > SIZE_LIMIT:
        raise NoReport(f"the report has more than {SIZE_LIMIT / 1e6:.0f} million characters")
    try:
        said = json.loads(text)
    except (ValueError, RecursionError):
        raise NoReport("what should be a report is no JSON") from None
    version = said.get("schema_version") if isinstance(said, dict) else None
    if version != SCHEMA_VERSION:
        shown = shortened(plain(repr(version)), 40)
        raise NoReport(f"the report's schema_version is {shown}, expected '{SCHEMA_VERSION}'")
    try:
        return _report(read_as(ReportJson, said))
    except Unfit as fault:
        raise NoReport(f"what should be a report is none: {shortened(str(fault), 200)}") from None


def _report(said: ReportJson) -> Report:
    return Report(
        tuple(map(_package, said.packages)),
        said.tool.versions,
        tuple(NotOpened(each.path, each.reason, each.failed) for each in said.not_opened),
    )


def _package(said: PackageJson) -> PackageReport:
    return PackageReport(
        name=said.name,
        path=said.path,
        kind=said.kind,
        findings=tuple(map(_finding, said.findings)),
        not_checked=tuple(NotChecked(e.rule, e.reason, e.cause) for e in said.not_checked),
        inherited=said.inherited,
        facts={name: value for name, value in said.facts.items() if _is_fact(name, value)},
        timings=said.timings,
        profile=said.profile,
        fail_on=said.fail_on,
        settings=said.settings,
        trial=said.trial,
        suppressed=tuple(map(_suppressed, said.suppressed)),
    )


def _finding(said: FindingJson) -> ReportedFinding:
    if not said.places:
        raise Unfit("places: expected one or more")
    places = tuple(map(_place, said.places))
    fix = None if said.fix is None else _fix(said.fix)
    return ReportedFinding(
        said.rule, said.name, said.severity, said.message, said.fingerprint, places, fix
    )


def _place(said: PlaceJson) -> Place:
    start, end = (said.line, said.column), (said.end_line, said.end_column)
    return Place(said.file, *start, *end, said.element, said.note, said.snippet)


def _fix(said: FixJson) -> Fix:
    return Fix(said.safety, tuple(map(_edit, said.edits)))


def _edit(said: EditJson) -> Edit:
    place = Place(said.file, said.line, said.column, said.end_line, said.end_column)
    return Edit(place, said.replacement, original="")


def _suppressed(said: SuppressedJson) -> Suppressed:
    place = None if said.place is None else _place(said.place)
    return Suppressed(_finding(said.finding), said.by, said.reason, place)


_TENSORS = ("inertia_kg_m2",)


def _is_fact(name: str, value: Any) -> bool:
    """Say whether a fact is a text, a number or a list of them; a later version may know others."""
    if name in _TENSORS:
        return isinstance(value, list) and all(map(_is_vector, value))
    return isinstance(value, str) or _is_number(value) or _is_vector(value)


def _is_vector(value: Any) -> bool:
    return isinstance(value, list) and all(map(_is_number, value))


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
