"""The report as SARIF 2.1.0, which code hosts and editors read: one run for all packages."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from urllib.parse import quote

from checker.base.record import Record
from checker.base.words import count, plain
from checker.finding import Place, Severity
from checker.report.ownership import each_once
from checker.report.report import (
    Cause,
    NotChecked,
    PackageReport,
    Report,
    ReportedFinding,
    Suppressed,
    SuppressedBy,
)
from checker.report.sarif_places import BASE, Json, fixes, location

# A finding as a result of SARIF.


RELATED_LIMIT = 100
"""Further places of a result that code hosts show."""

LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}


class PackageFinding(Record):
    """A finding, of which package, and its suppression."""

    package: PackageReport
    finding: ReportedFinding
    suppressed: Suppressed | None = None

    @property
    def in_baseline(self) -> bool:
        """True if it is in the baseline."""
        return self.suppressed is not None and self.suppressed.by is SuppressedBy.BASELINE

    @property
    def set_aside(self) -> bool:
        """True if a comment or settings suppress it."""
        return self.suppressed is not None and not self.in_baseline


class Marks(Record):
    """Properties that all results of a run have as soon as one does, as SARIF requires."""

    baseline: bool
    suppressions: bool


def result(item: PackageFinding, index: int, marks: Marks, folder: str) -> Json:
    """Return a result.

    Args:
        item: What was found.
        index: The index of its rule among the run's.
        marks: What it carries besides.
        folder: The folder in which the command was run.
    """
    package, finding = item.package, item.finding
    first, *others = finding.places
    members: Json = {
        "ruleId": finding.rule,
        "ruleIndex": index,
        "level": LEVELS[finding.severity],
        "message": {"text": plain_text(finding.message)},
        "locations": [location(first, package, folder)],
        "partialFingerprints": {"subtCheck/v1": finding.fingerprint},
        "properties": {"package": plain(package.name)},
    }
    if finding.also:
        members["properties"]["also"] = list(finding.also)
    if others:
        related = (_related(other, package, folder) for other in others[:RELATED_LIMIT])
        # The standard wants them distinct, and words made plain may have become alike.
        members["relatedLocations"] = list({str(place): place for place in related}.values())
        members["occurrenceCount"] = 1 + sum(not other.note for other in others)
    if fix := fixes(finding.fix, finding.how, package, folder):
        members["fixes"] = fix
    if marks.baseline:
        members["baselineState"] = "unchanged" if item.in_baseline else "new"
    if marks.suppressions:
        members["suppressions"] = _suppressions(item, folder) if item.set_aside else []
    return members


def plain_text(message: str) -> str:
    """Return a message in which nothing is a link: SARIF reads `[text](target)` as one."""
    return plain(message).replace("](", "] (")


def _related(place: Place, package: PackageReport, folder: str) -> Json:
    text = plain_text(place.note or place.message or "also here")
    return {**location(place, package, folder), "message": {"text": text}}


def _suppressions(item: PackageFinding, folder: str) -> list[Json]:
    aside = item.suppressed
    if aside is None:
        return []
    kind = "inSource" if aside.by is SuppressedBy.COMMENT else "external"
    suppression: Json = {"kind": kind, "status": "accepted", "justification": plain(aside.reason)}
    if aside.place is not None:
        suppression["location"] = location(aside.place, item.package, folder)
    return [suppression]


SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)
RULE_PAGES = "https://OWNER.github.io/subt-check/rules"
"""The pages of rules on the site that `make docs` builds."""
RESULTS_LIMIT = 5000
"""Results of a run that code hosts show."""
NOTIFICATIONS_LIMIT = 1000


def to_sarif(report: Report, folder: str) -> str:
    """Return the report as a SARIF log, in plain ASCII.

    Args:
        report: What was found.
        folder: The folder in which the command was run, absolute; paths below it are written
            relative to it.
    """
    log = {"$schema": SCHEMA, "version": "2.1.0", "runs": [_run(report, folder)]}
    return json.dumps(log, indent=1) + "\n"


def _run(report: Report, folder: str) -> Json:
    findings = sorted(
        _all_findings(report),
        key=lambda item: (item.suppressed is not None, item.finding.severity.rank),
    )
    shown = findings[:RESULTS_LIMIT]
    rules = _first_by_rule(shown)
    driver: Json = {"name": "subt-check", "rules": [_rule(rule) for rule in rules.values()]}
    # An installation may not know its own version.
    if (version := report.versions.get("subt-check", ""))[:1].isdigit():
        driver["version"] = plain(version)
    indices = {rule: index for index, rule in enumerate(rules)}
    marks = Marks(
        any(item.in_baseline for item in findings), any(item.set_aside for item in findings)
    )
    return {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "originalUriBaseIds": {
            BASE: {"description": {"text": "The folder where subt-check was run."}}
        },
        "invocations": [_invocation(report, len(findings) - len(shown))],
        "results": [result(item, indices[item.finding.rule], marks, folder) for item in shown],
        "properties": {"packages": [_package(package) for package in report.packages]},
    }


def _all_findings(report: Report) -> Iterator[PackageFinding]:
    for package, finding in each_once(report):
        yield PackageFinding(package, finding)
    for package in report.packages:
        for suppressed in package.suppressed:
            yield PackageFinding(package, suppressed.finding, suppressed)


def _package(package: PackageReport) -> Json:
    return {"name": plain(package.name), "verdict": str(package.verdict)}


def _first_by_rule(findings: Sequence[PackageFinding]) -> Mapping[str, ReportedFinding]:
    """Return the first finding of each rule, which is the most severe that counts."""
    rules: dict[str, ReportedFinding] = {}
    for item in findings:
        rules.setdefault(item.finding.rule, item.finding)
    return rules


def _rule(finding: ReportedFinding) -> Json:
    """Describe a rule by what its findings quote of its page."""
    parts = [("", finding.why), ("Fix: ", finding.how), ("Source: ", finding.source)]
    labelled = [(label, plain(text)) for label, text in parts if text]
    text = [f"{label}{words}" for label, words in labelled]
    marked = [f"**{label.strip()}** {words}" if label else words for label, words in labelled]
    rule: Json = {
        "id": finding.rule,
        "name": "".join(word[:1].upper() + word[1:] for word in plain(finding.name).split("-")),
        "shortDescription": {"text": plain(finding.title or finding.name)},
        "helpUri": help_uri(finding.rule),
        "help": {
            "text": "\n\n".join([*text, finding.help]),
            "markdown": "\n\n".join([*marked, f"`{finding.help}`"]),
        },
        "defaultConfiguration": {"level": LEVELS[finding.severity]},
        "properties": {"tags": [finding.rule.rstrip("0123456789"), str(finding.concern)]},
    }
    if finding.why:
        rule["fullDescription"] = {"text": plain(finding.why)}
    return rule


def help_uri(rule: str) -> str:
    """Return where the page of a rule is on the web.

    Args:
        rule: Its id.
    """
    return f"{RULE_PAGES}/{quote(plain(rule))}.html"


def _invocation(report: Report, left_out: int) -> Json:
    """Return what went wrong or could not be read."""
    crashed = any(package.crashed for package in report.packages)
    failed = any(item.failed for item in report.not_opened)
    notifications = [
        _notification(n, package) for package in report.packages for n in package.blind_spots
    ]
    for item in report.not_opened:
        level = "error" if item.failed else "note"
        text = f"{plain(item.path)} {plain(item.reason)}"
        notifications.append({"level": level, "message": {"text": plain_text(text)}})
    notifications = sorted(notifications, key=lambda n: str(n["level"]))[:NOTIFICATIONS_LIMIT]
    if left_out:
        text = f"{count(left_out, 'result')} left out, {RESULTS_LIMIT} shown, the most severe first"
        notifications.append({"level": "warning", "message": {"text": text}})
    return {
        "executionSuccessful": not (crashed or failed),
        "toolExecutionNotifications": notifications,
    }


def _notification(unseen: NotChecked, package: PackageReport) -> Json:
    text = f"{package.name}: {unseen.rule} was not checked: {unseen.reason}"
    return {
        "level": "error" if unseen.cause is Cause.CRASHED else "note",
        "message": {"text": plain_text(text)},
        "associatedRule": {"id": plain(unseen.rule)},
    }
