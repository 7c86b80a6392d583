"""A finding as a result of SARIF."""

from __future__ import annotations

from checker.finding import Place, Severity
from checker.record import record
from checker.report.report import PackageReport, ReportedFinding, Suppressed, SuppressedBy
from checker.report.sarif_places import Json, fixes, location
from checker.report.wording import plain

RELATED_LIMIT = 100
"""Further places of a result that code hosts show."""

LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}


@record()
class Said:
    """A finding, of which package, and what set it aside."""

    package: PackageReport
    finding: ReportedFinding
    suppressed: Suppressed | None = None

    @property
    def in_baseline(self) -> bool:
        """Whether it was there before."""
        return self.suppressed is not None and self.suppressed.by is SuppressedBy.BASELINE

    @property
    def set_aside(self) -> bool:
        """Whether a comment or settings say that it does not count."""
        return self.suppressed is not None and not self.in_baseline


@record()
class Marks:
    """Which marks all results of a run carry as soon as one does, as SARIF asks."""

    baseline: bool
    suppressions: bool


def result(said: Said, index: int, marks: Marks, folder: str) -> Json:
    """Return a result.

    Args:
        said: What was found.
        index: Of its rule among the run's.
        marks: What it carries besides.
        folder: Where the command was run.
    """
    package, finding = said.package, said.finding
    first, *others = finding.places
    made: Json = {
        "ruleId": finding.rule,
        "ruleIndex": index,
        "level": LEVELS[finding.severity],
        "message": {"text": words(finding.message)},
        "locations": [location(first, package, folder)],
        "partialFingerprints": {"subtCheck/v1": finding.fingerprint},
        "properties": {"package": plain(package.name)},
    }
    if others:
        related = (_related(each, package, folder) for each in others[:RELATED_LIMIT])
        # The standard wants them distinct, and words made plain may have become alike.
        made["relatedLocations"] = list({str(each): each for each in related}.values())
        made["occurrenceCount"] = 1 + sum(not each.note for each in others)
    if fix := fixes(finding.fix, finding.how, package, folder):
        made["fixes"] = fix
    if marks.baseline:
        made["baselineState"] = "unchanged" if said.in_baseline else "new"
    if marks.suppressions:
        made["suppressions"] = _suppressions(said, folder) if said.set_aside else []
    return made


def words(message: str) -> str:
    """Return a message in which nothing is a link: SARIF reads `[text](target)` as one."""
    return plain(message).replace("](", "] (")


def _related(place: Place, package: PackageReport, folder: str) -> Json:
    said = words(place.note) if place.note else "also here"
    return {**location(place, package, folder), "message": {"text": said}}


def _suppressions(said: Said, folder: str) -> list[Json]:
    aside = said.suppressed
    if aside is None:
        return []
    kind = "inSource" if aside.by is SuppressedBy.COMMENT else "external"
    found: Json = {"kind": kind, "status": "accepted", "justification": plain(aside.reason)}
    if aside.place is not None:
        found["location"] = location(aside.place, said.package, folder)
    return [found]
