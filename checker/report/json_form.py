"""The members of the JSON report by type: written ones, read ones, and the schema.

A report that is read may come from another machine, and a terminal shows it: words that the checker
chooses itself must look like such words, and line numbers like line numbers.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal, NotRequired, TypedDict

import msgspec
from msgspec import UNSET, Meta, UnsetType

from checker.base.record import Record
from checker.finding import Concern, Safety, Severity
from checker.package.kind import PackageKind
from checker.report.launched import Launched
from checker.report.report import SCHEMA_VERSION, Cause, InheritedPart, SuppressedBy, VerdictKind

_END = r"$(?!\n)"
"""The end of a text: Python's `$` alone also matches in front of a line's end."""
Word = Annotated[str, Meta(pattern=rf"^[A-Za-z0-9_-]{{1,100}}{_END}")]
"""An id or a name of the checker's own."""
RuleId = Annotated[str, Meta(pattern=rf"^[A-Z][A-Z0-9]*[0-9]{_END}", max_length=100)]
Fingerprint = Annotated[str, Meta(pattern=rf"^[0-9a-f]{{16}}{_END}")]
Count = Annotated[int, Meta(ge=1, lt=10**9)]
"""A line or a column."""


class PlaceJson(Record):
    """A stretch of a file."""

    file: Annotated[
        str, Meta(description="Relative to the package folder; empty for the folder itself.")
    ]
    line: Count
    column: Annotated[Count, Meta(description="In characters.")]
    end_line: Count
    end_column: Count
    element: str
    note: str
    snippet: Annotated[str, Meta(description="The text of the line.")] = ""
    message: Annotated[
        str, Meta(description="The fault here, if it differs from the finding's message.")
    ] = ""


class EditJson(Record):
    """An edit and its stretch in one."""

    file: str
    line: Count
    column: Count
    end_line: Count
    end_column: Count
    replacement: str
    snippet: Annotated[str, Meta(description="The text of the first line.")] = ""


class FixJson(Record):
    """Edits that belong together."""

    safety: Safety
    edits: tuple[EditJson, ...]


class RepeatJson(Record):
    """Finding of another rule about the same fault."""

    rule: RuleId
    name: Word
    severity: Severity
    message: Annotated[str, Meta(min_length=1)]
    places: Annotated[tuple[PlaceJson, ...], Meta(min_length=1)]


class FindingJson(Record):
    """A finding without what its rule's page states."""

    rule: RuleId
    name: Word
    severity: Severity
    concern: Concern
    message: Annotated[str, Meta(min_length=1)]
    fingerprint: Fingerprint
    places: Annotated[tuple[PlaceJson, ...], Meta(min_length=1)]
    help: Annotated[str, Meta(description="The command that shows the rule's page.")]
    fix: FixJson | UnsetType = UNSET
    repeats: Annotated[
        tuple[RepeatJson, ...] | UnsetType,
        Meta(description="Findings of less precise rules about the same fault."),
    ] = UNSET


class SuppressedJson(Record):
    """A finding that does not count."""

    finding: FindingJson
    by: SuppressedBy
    reason: str
    place: Annotated[
        PlaceJson | None, Meta(description="Of the comment; null for suppressions elsewhere.")
    ]


class NotCheckedJson(Record):
    """A rule that did not look."""

    rule: Word
    reason: str
    cause: Cause
    severity: Annotated[
        Severity | None, Meta(description="Of the findings that it may have missed.")
    ] = None
    concern: Concern | None = None


class LegJson(TypedDict):
    """A stretch of the course: seconds, m/s and rad/s."""

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
    unit: Annotated[str, Meta(description="SI; empty for ratios.")]
    part: Annotated[str, Meta(description="Link or joint that it is about; empty for the robot.")]
    other: Annotated[str, Meta(description="The second part of a pair; `ground` for the ground.")]
    rule: Annotated[
        str, Meta(description="Rule that judges it; empty if it is for information only.")
    ]
    limits: Annotated[
        Mapping[Word, float], Meta(description="Options of that rule, as they were used.")
    ]
    verdict: Literal["ok", "info", "warning", "error", "not judged"]


class RepairJson(TypedDict):
    """Change without which the trial could not run."""

    part: str
    what: str
    serious: bool


class TrialJson(TypedDict):
    """Course and results of a trial."""

    robot: NotRequired[
        Annotated[
            int,
            Meta(
                description="Number of the robot, if there are several: 0 for the robot of"
                " `facts`, 1 for the first of `other_robots`."
            ),
        ]
    ]
    not_driven: NotRequired[
        Annotated[str, Meta(description="Reason why a robot that can move was not driven.")]
    ]
    moved: NotRequired[
        Annotated[
            str,
            Meta(
                description="What was moved joint by joint: `6 joints by"
                " JointTrajectoryController 'arm'`."
            ),
        ]
    ]
    drive: str
    versions: Annotated[Mapping[str, str], Meta(description="Of MuJoCo and of the course.")]
    course: Annotated[
        list[LegJson],
        Meta(description="Commands; empty if MuJoCo refused the model."),
    ]
    refused: Annotated[str, Meta(description="Reason why MuJoCo refused the model; else empty.")]
    refused_part: str
    measurements: list[MeasurementJson]
    repairs: list[RepairJson]
    notes: list[str]
    trouble: list[str]
    series: Annotated[
        Mapping[str, list[float | None]],
        Meta(
            description="Samples by name, all of one length: time, x, y, z, roll, pitch, yaw,"
            " speed, yaw_rate, command_linear, command_angular, load:<link>, torque:<joint>,"
            " joint:<joint>; SI units."
        ),
    ]


_VECTOR = {"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number"}}
_TENSOR = {"type": "array", "minItems": 3, "maxItems": 3, "items": _VECTOR}
_FACTS: Mapping[str, Any] = {
    "robot": {"type": "string"},
    "scene": {
        "type": "string",
        "description": "Instead of `robot`: name of a model of MuJoCo without any body.",
    },
    "file": {
        "type": "string",
        "description": "File of the robot, if a package has several robots.",
    },
    "not_driven": {
        "type": "string",
        "description": "Reason why the robot, one of several, has no trial.",
    },
    "assumed": {"type": "string", "description": "Values chosen for arguments that are not given."},
    "also_tried": {
        "type": "string",
        "description": "Values of xacro's arguments that give other robots, which are judged too.",
    },
    "mass_kg": {"type": "number"},
    "links": {"type": "integer"},
    "joints": {"type": "integer"},
    "sensors": {"type": "integer"},
    "plugins": {"type": "integer"},
    "drive": {"type": "string"},
    "size_m": _VECTOR | {"description": "Sides of the box around it."},
    "collision_triangles": {"type": "integer", "description": "Of meshes."},
    "visual_triangles": {"type": "integer", "description": "Of meshes."},
    "centre_of_mass_m": _VECTOR | {"description": "In the robot's frame."},
    "inertia_kg_m2": _TENSOR | {"description": "About the centre of mass, rows."},
    "tip_angle_deg": {
        "type": "number",
        "description": "Greatest tilt of the ground at which the robot stands.",
    },
    "thrust_to_weight": {"type": "number"},
}


class PackageJson(Record, kw_only=True):
    """A package; readers of a report compute the verdict from the rest."""

    name: str
    path: Annotated[str, Meta(description="As given to the checker.")]
    kind: Annotated[Word, Meta(extra_json_schema={"enum": list(map(str, PackageKind))})]
    profile: Annotated[Word, Meta(description="Profile that judged it.")]
    target_reason: Annotated[
        str,
        Meta(description="Simulator or ROS 2 distribution found in its content, and the place."),
    ] = ""
    settings: Annotated[str, Meta(description="Changes of a settings file; empty without one.")] = (
        ""
    )
    fail_on: Annotated[
        Severity, Meta(description="Findings of this severity or above make the command fail.")
    ] = Severity.ERROR
    verdict: VerdictKind
    inherited: tuple[InheritedPart, ...]
    findings: tuple[FindingJson, ...]
    suppressed: Annotated[
        tuple[SuppressedJson, ...], Meta(description="Findings that do not count.")
    ]
    not_checked: tuple[NotCheckedJson, ...]
    trial: TrialJson | None = None
    facts: Annotated[
        Mapping[str, Any],
        Meta(
            description="Facts about the robot; those that no rule needed are missing.",
            extra_json_schema={"properties": _FACTS},
        ),
    ]
    timings: Annotated[Mapping[str, float], Meta(description="Seconds by stage.")]
    other_robots: Annotated[
        tuple[Mapping[str, Any], ...], Meta(description="Facts of the further robots.")
    ] = ()
    other_trials: Annotated[
        tuple[TrialJson, ...], Meta(description="Of further robots that were driven.")
    ] = ()
    launched: Annotated[
        tuple[Launched, ...], Meta(description="The graphs of launch files of ROS 2.")
    ] = ()


class NotOpenedJson(Record):
    """Input, or something below it, that was not checked at all."""

    path: str
    reason: str
    failed: Annotated[
        bool, Meta(description="Whether the user named it, so that the run has failed.")
    ] = False


class ToolJson(Record, kw_only=True):
    """Program that wrote the report."""

    name: str = "subt-check"
    versions: Mapping[str, str]


class ReportJson(Record):
    """Version 1: members may be added, none is removed or changes its meaning."""

    schema_version: Literal["1"]
    tool: ToolJson
    packages: tuple[PackageJson, ...]
    not_opened: tuple[NotOpenedJson, ...]


def report_schema() -> dict[str, Any]:
    """Return the JSON schema of a report, as the types above have it."""
    schema = msgspec.json.schema(ReportJson)
    head = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": f"urn:subt-check:report:{SCHEMA_VERSION}",
        "title": "Report of subt-check",
    }
    return head | schema
