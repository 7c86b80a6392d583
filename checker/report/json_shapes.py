"""The members of the JSON report by type, as far as a report is made of them again.

Reports come from other machines, and a terminal shows them: words that the checker chooses itself
must look like such words, and numbers of lines like numbers of lines.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Annotated, Any, Literal, TypedDict

from checker.base.record import Record
from checker.finding import Safety, Severity
from checker.report.report import Cause, InheritedPart, SuppressedBy

Word = Annotated[str, re.compile(r"[A-Za-z0-9_-]{1,100}")]
"""An id or a name of the checker's own."""
Count = Annotated[int, range(1, 10**9)]
"""A line or a column."""


class PlaceJson(Record):
    """A stretch of a file."""

    file: str
    line: Count
    column: Count
    end_line: Count
    end_column: Count
    element: str = ""
    note: str = ""
    snippet: str = ""


class EditJson(Record):
    """An edit and its stretch in one."""

    file: str
    line: Count
    column: Count
    end_line: Count
    end_column: Count
    replacement: str


class FixJson(Record):
    """Edits that belong together."""

    safety: Safety
    edits: tuple[EditJson, ...]


class FindingJson(Record):
    """A finding without what its rule's page says."""

    rule: Word
    name: Word
    severity: Severity
    message: str
    fingerprint: Word
    places: tuple[PlaceJson, ...]
    fix: FixJson | None = None


class SuppressedJson(Record):
    """A finding that does not count."""

    finding: FindingJson
    by: SuppressedBy
    reason: str
    place: PlaceJson | None


class NotCheckedJson(Record):
    """A rule that did not look."""

    rule: Word
    reason: str
    cause: Cause


class LegJson(TypedDict):
    """A stretch of the course."""

    name: str
    start: float
    end: float
    linear: float
    angular: float


class MeasurementJson(TypedDict):
    """A figure of the trial."""

    name: str
    label: str
    value: float
    unit: str
    part: str
    other: str
    rule: str
    limits: Mapping[Word, float]
    verdict: Literal["ok", "info", "warning", "error", "not judged"]


class RepairJson(TypedDict):
    """What was changed so that the trial could go on."""

    part: str
    what: str
    serious: bool


class TrialJson(TypedDict):
    """A trial; what is unknown of it is kept as it is."""

    drive: str
    versions: Mapping[str, str]
    course: list[LegJson]
    refused: str
    refused_part: str
    measurements: list[MeasurementJson]
    repairs: list[RepairJson]
    notes: list[str]
    trouble: list[str]
    series: Mapping[str, list[float | None]]


class PackageJson(Record):
    """A package; its verdict follows from the rest."""

    name: str
    path: str
    kind: Word
    profile: Word
    inherited: tuple[InheritedPart, ...]
    findings: tuple[FindingJson, ...]
    suppressed: tuple[SuppressedJson, ...]
    not_checked: tuple[NotCheckedJson, ...]
    facts: Mapping[str, Any]
    timings: Mapping[str, float]
    trial: TrialJson | None = None
    settings: str = ""
    fail_on: Severity = Severity.ERROR


class NotOpenedJson(Record):
    """What was not checked at all."""

    path: str
    reason: str
    failed: bool = False


class ToolJson(Record):
    """What wrote the report."""

    versions: Mapping[str, str]


class ReportJson(Record):
    """The whole report."""

    schema_version: Word
    tool: ToolJson
    packages: tuple[PackageJson, ...]
    not_opened: tuple[NotOpenedJson, ...]
