"""Results of a check: verdicts, findings, and rules that were not checked, with the reasons."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from typing import Any, Final

from msgspec import field

from checker.base.extras import PHYSICS
from checker.base.record import Record
from checker.finding import Concern, Fix, Place, Severity
from checker.package.kind import PackageKind
from checker.report.launched import Launched

SCHEMA_VERSION: Final = "1"
USUAL_PROFILE = "subt"
NO_TRIAL = "trial not run (--no-trial)"
"""Reason why rules about the trial are not checked if the user switches it off."""
FILES = "files"
"""Value of `NotChecked.rule` if files or folders could not be read."""
ROBOT = "robot"
"""Value of `NotChecked.rule` if a robot could not be read."""
NO_PHYSICS = PHYSICS.missing_message
"""Reason why rules that need it are not checked; like what the user switched off, it hides no
error."""


class VerdictKind(enum.StrEnum):
    """Verdict for a package.

    `READY`: no error. `PAPERWORK`: errors of the paperwork alone. `NOT_READY`: others.
    `INCOMPLETE`: no other error, but a rule that may find one was not checked.
    """

    READY = "ready"
    PAPERWORK = "paperwork"
    NOT_READY = "not_ready"
    INCOMPLETE = "incomplete"

    @property
    def lead(self) -> str:
        """The beginning of a sentence that states it."""
        return _LEADS[self]


_LEADS = {
    VerdictKind.READY: "Ready",
    VerdictKind.PAPERWORK: "Ready once the paperwork is done",
    VerdictKind.NOT_READY: "Not ready",
    VerdictKind.INCOMPLETE: "Incomplete",
}


class Cause(enum.StrEnum):
    """Cause why a rule is not checked.

    `NOT_AT_HAND` and `CRASHED` keep a package from being ready; what was switched off, is not
    applicable, or is in a format that is not supported beside a robot that was read, does not.
    """

    NOT_AT_HAND = "not_at_hand"
    NOT_APPLICABLE = "not_applicable"
    NOT_SUPPORTED = "not_supported"
    SWITCHED_OFF = "switched_off"
    CRASHED = "crashed"


class NotChecked(Record):
    """A rule that did not look, and why.

    Attributes:
        severity: The severity of what it may have missed; None if that is not known.
        concern: What it may have missed is about; None if that is not known.
        momentary: Whether it may look the next time: the disk or the system failed.
    """

    rule: str
    reason: str
    cause: Cause
    severity: Severity | None = None
    concern: Concern | None = None
    momentary: bool = False

    @property
    def may_hide_error(self) -> bool:
        """True if the rule might have found an error."""
        return self.severity in (Severity.ERROR, None)


class Repeat(Record):
    """The finding of another rule about a fault that a finding describes more precisely."""

    rule: str
    name: str
    severity: Severity
    message: str
    places: tuple[Place, ...]


class ReportedFinding(Record):
    """A fault, with all its places.

    Attributes:
        rule: Id of the rule.
        name: Name of the rule: what is wrong.
        fingerprint: The same as long as the fault is the same, wherever the lines move.
        why: First words of the rule's page.
        how: The way to correct it, from the rule's page.
        key: What its places have in common, where the rule states it.
        title: The title of the rule's page: what is wrong in general.
        source: The source of the rule.
        fixes: The fixes of its faults where it joins several places.
        repeats: What less precise rules state about the same fault.
    """

    rule: str
    name: str
    severity: Severity
    concern: Concern
    message: str
    fingerprint: str
    places: tuple[Place, ...]
    fix: Fix | None = None
    why: str = ""
    how: str = ""
    key: str = ""
    title: str = ""
    source: str = ""
    fixes: tuple[Fix, ...] = ()
    repeats: tuple[Repeat, ...] = ()

    @property
    def also(self) -> tuple[str, ...]:
        """The ids of the other rules that report the same fault."""
        return tuple(dict.fromkeys(repeat.rule for repeat in self.repeats))

    @property
    def help(self) -> str:
        """The command that shows the rule's page."""
        return f"subt-check rule {self.rule}"


class InheritedPart(Record):
    """A part that a package takes from another one."""

    part: str
    package: str
    at_hand: bool


class SuppressedBy(enum.StrEnum):
    """Source of a suppression: a comment, a settings file, or the baseline."""

    COMMENT = "comment"
    SETTINGS = "settings"
    BASELINE = "baseline"


IN_BASELINE = "in the baseline"
"""The default reason for what the baseline sets aside."""


class Suppressed(Record):
    """A finding that the user has seen and set aside.

    Attributes:
        finding: The finding as it would have been reported.
        reason: The user's reason; for the baseline, a default one.
        place: The place of the comment; None for one elsewhere.
    """

    finding: ReportedFinding
    by: SuppressedBy
    reason: str
    place: Place | None = None


class Picture(Record):
    """The robot at one moment.

    Attributes:
        caption: What it shows, a sentence without its dot.
        jpeg: The file.
        width: Pixels.
        height: Pixels.
    """

    caption: str
    jpeg: bytes
    width: int
    height: int


class Display(Record):
    """The robot in 3D, for display.

    Attributes:
        glb: A binary glTF file: the robot in layers, its trial as an animation.
        pictures: The same for those without a 3D viewer; none if nothing can draw them.
        notes: What is not shown, or coarser than it is, as sentences.
    """

    glb: bytes
    pictures: tuple[Picture, ...] = ()
    notes: tuple[str, ...] = ()


class PackageReport(Record):
    """All that was found out about one package.

    Attributes:
        path: The path as the user gave it.
        kind: `robot`, `configuration`, `plugin`, ….
        profile: Name of the profile that judged it.
        fail_on: Findings at or above this severity make the run fail.
        settings: What a settings file changed, in words; empty if there is none.
        facts: Mass, links, joints, … of the first robot, by name.
        trial: What was driven and measured, as the JSON report has it; None without a trial.
            Of several robots, that of the first that was driven.
        timings: Seconds by stage.
        suppressed: What was found and does not count.
        display: The robot in 3D; None if it was not requested, or where there is nothing to see.
        patch: What the safe fixes change, where the display was requested.
        looked: Ids of the rules that ran on complete data.
        other_robots: Facts of the further robots of the package.
        other_trials: The trials of further robots that were driven.
        disturbed: Why something was not checked that may be the next time, such as a process that
            was killed from outside: the first of these reasons; empty without any.
        target_reason: The simulator or ROS 2 distribution detected from the content of the package,
            and the evidence; empty if the user or a default chose it.
        launched: The graphs of its launch files of ROS 2.
        neighbours: Names of the packages in whose files findings are, by the paths of these files.
        vendored: Folder of the copied repository that it is in; empty for the user's own packages.
    """

    name: str
    path: str
    kind: str
    findings: tuple[ReportedFinding, ...]
    not_checked: tuple[NotChecked, ...] = ()
    inherited: tuple[InheritedPart, ...] = ()
    facts: Mapping[str, Any] = field(default_factory=dict)
    timings: Mapping[str, float] = field(default_factory=dict)
    profile: str = USUAL_PROFILE
    fail_on: Severity = Severity.ERROR
    settings: str = ""
    trial: Mapping[str, Any] | None = None
    suppressed: tuple[Suppressed, ...] = ()
    display: Display | None = None
    patch: str = ""
    looked: tuple[str, ...] = ()
    other_robots: tuple[Mapping[str, Any], ...] = ()
    other_trials: tuple[Mapping[str, Any], ...] = ()
    disturbed: str = ""
    target_reason: str = ""
    launched: tuple[Launched, ...] = ()
    neighbours: Mapping[str, str] = field(default_factory=dict)
    vendored: str = ""

    @property
    def lateness(self) -> tuple[bool, bool]:
        """A sort key: models come behind packages, those of copied repositories last."""
        return bool(self.vendored), self.kind == PackageKind.BASE_MODEL

    @property
    def verdict(self) -> VerdictKind:
        """Verdict for the package."""
        concerns = {finding.concern for finding in self.errors}
        if concerns - {Concern.PAPERWORK}:
            return VerdictKind.NOT_READY
        hidden = {unseen.concern for unseen in self.blind_spots if unseen.may_hide_error}
        if hidden - {Concern.PAPERWORK}:
            return VerdictKind.INCOMPLETE
        if concerns:
            return VerdictKind.PAPERWORK
        return VerdictKind.INCOMPLETE if hidden else VerdictKind.READY

    @property
    def errors(self) -> tuple[ReportedFinding, ...]:
        """The findings that are errors."""
        return tuple(found for found in self.findings if found.severity is Severity.ERROR)

    @property
    def blind_spots(self) -> tuple[NotChecked, ...]:
        """Rules that should have looked and could not."""
        return tuple(n for n in self.not_checked if n.cause in (Cause.NOT_AT_HAND, Cause.CRASHED))

    @property
    def crashed(self) -> bool:
        """True if a rule could not run because of the checker itself."""
        return any(n.cause is Cause.CRASHED for n in self.not_checked)

    @property
    def failed(self) -> bool:
        """True if there is a finding at or above the severity that makes the run fail."""
        return any(finding.severity.rank <= self.fail_on.rank for finding in self.findings)

    def count(self, severity: Severity) -> int:
        """Return the number of findings of one severity."""
        return sum(finding.severity is severity for finding in self.findings)


class NotOpened(Record):
    """An argument, or a folder below one, that was not checked at all, and why.

    Attributes:
        path: The path as the user gave it.
        reason: The end of a sentence that starts with the path.
        failed: Whether the user named it, so that the run has failed.
        disturbed: What failed of the disk or the system, if that is why; else empty.
    """

    path: str
    reason: str
    failed: bool
    disturbed: str = ""


class Report(Record):
    """The reports of all packages of one run: packages, models, then copied repositories."""

    packages: tuple[PackageReport, ...]
    versions: Mapping[str, str]
    not_opened: tuple[NotOpened, ...] = ()
