"""Reports for build servers: GitHub's annotations of lines, and JUnit XML."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from xml.etree import ElementTree as ET

from checker.base.words import and_list, count, plain, shortened
from checker.finding import Severity
from checker.report.finding_text import MESSAGE_LIMIT, path_of
from checker.report.ownership import each_once
from checker.report.report import Cause, NotChecked, PackageReport, Report, ReportedFinding
from checker.report.summary import sentence

# The report as JUnit XML, which build servers read: a suite per package, a case per rule.


FINDINGS_LIMIT = 100
"""Findings of one rule that are written out; the rest is counted."""

_NOT_XML = re.compile("[\ufffe\uffff]")


def to_junit(report: Report) -> str:
    """Return the report in the dialect that Jenkins' XSD describes."""
    suites = ET.Element("testsuites", name="subt-check")
    suites.extend(_suite(package) for package in report.packages)
    suites.extend(_unopened(item.path, item.reason) for item in report.not_opened if item.failed)
    for kind in ("tests", "failures", "errors"):
        suites.set(kind, str(sum(int(suite.get(kind, "0")) for suite in suites)))
    ET.indent(suites)
    written: str = ET.tostring(suites, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{written}\n'


def _xml(text: str) -> str:
    """Replace characters that XML cannot contain, even escaped."""
    return _NOT_XML.sub("\N{REPLACEMENT CHARACTER}", plain(text))


def _suite(package: PackageReport) -> ET.Element:
    by_rule: dict[str, list[ReportedFinding]] = {}
    for finding in package.findings:
        by_rule.setdefault(finding.rule, []).append(finding)
    unseen: dict[str, list[NotChecked]] = {}
    for missing in package.not_checked:
        unseen.setdefault(missing.rule, []).append(missing)
    rules = sorted({*package.looked, *by_rule, *unseen})
    cases = [_case(rule, package, by_rule.get(rule, ()), unseen.get(rule, ())) for rule in rules]
    return _counted(package.name, cases, sum(package.timings.values()))


def _unopened(path: str, reason: str) -> ET.Element:
    case = ET.Element("testcase", classname=_xml(path), name="open")
    ET.SubElement(case, "error", message=_xml(f"{path} {reason}"), type="not opened")
    return _counted(path, [case], 0.0)


def _counted(name: str, cases: Sequence[ET.Element], seconds: float) -> ET.Element:
    """Return the suite of some cases; each counts for the most severe thing in it."""
    kinds = [{child.tag for child in case} for case in cases]
    suite = ET.Element("testsuite", name=_xml(name), tests=str(len(cases)))
    suite.set("failures", str(sum("failure" in kind for kind in kinds)))
    suite.set("errors", str(sum("error" in kind for kind in kinds)))
    suite.set("skipped", str(sum("skipped" in kind for kind in kinds)))
    suite.set("time", f"{seconds:.3f}")
    suite.extend(cases)
    return suite


def _case(
    rule: str,
    package: PackageReport,
    findings: Sequence[ReportedFinding],
    unseen: Sequence[NotChecked],
) -> ET.Element:
    """Return a case; its name is the rule's id alone, so that its history is one over time."""
    case = ET.Element("testcase", classname=_xml(package.name), name=_xml(rule))
    failing = [reported for reported in findings if reported.severity.rank <= package.fail_on.rank]
    lesser = [reported for reported in findings if reported.severity.rank > package.fail_on.rank]
    reasons = "; ".join(dict.fromkeys(skipped.reason for skipped in unseen))
    if any(skipped.cause is Cause.CRASHED for skipped in unseen):
        ET.SubElement(case, "error", message=_xml(reasons), type="crashed")
    if failing:
        first = failing[0]
        more = f" (and {len(failing) - 1} more)" if len(failing) > 1 else ""
        message, kind = _xml(first.message + more), f"{first.severity} {first.name}"
        failure = ET.SubElement(case, "failure", message=message, type=_xml(kind))
        failure.text = _written(failing, package)
    if unseen and not len(case):
        ET.SubElement(case, "skipped", message=_xml(reasons))
    elif unseen:
        ET.SubElement(case, "system-out").text = f"not checked: {_xml(reasons)}\n"
    if lesser:
        ET.SubElement(case, "system-out").text = _written(lesser, package)
    return case


def _written(findings: Sequence[ReportedFinding], package: PackageReport) -> str:
    """Write findings one a line, then why and how once: they are of one rule."""
    lines = [_line(finding, package) for finding in findings[:FINDINGS_LIMIT]]
    if len(findings) > FINDINGS_LIMIT:
        lines.append(f"… and {count(len(findings) - FINDINGS_LIMIT, 'more finding')}")
    first = findings[0]
    lines += [f"why: {_xml(first.why)}"] * bool(first.why)
    lines += [f"fix: {_xml(first.how)}"] * bool(first.how)
    return "\n".join([*lines, first.help]) + "\n"


def _line(reported: ReportedFinding, package: PackageReport) -> str:
    place = reported.places[0]
    where = path_of(place, package) + (f":{place.line}:{place.column}" if place.file else "/")
    repeats = sum(not other.note for other in reported.places[1:])
    more = f" (and {count(repeats, 'more place')})" if repeats else ""
    more += f" (also {', '.join(reported.also)})" if reported.also else ""
    message = shortened(reported.message, 600)
    return _xml(f"{where} {reported.severity} {reported.rule} {reported.name}: {message}{more}")


LINES_LIMIT = 50
"""Annotations of one severity; GitHub shows ten of each a step and fifty a job."""

_COMMAND = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}


def to_github(report: Report) -> str:
    """Return one workflow command a line, the most severe first; then counts and verdicts."""
    findings = list(each_once(report))
    lines = [
        _command("error", {"title": "not opened"}, plain(f"{item.path} {item.reason}"))
        for item in report.not_opened
        if item.failed
    ]
    for severity in Severity:
        of_one = [
            (package, reported) for package, reported in findings if reported.severity is severity
        ]
        lines += [_annotation(reported, package) for package, reported in of_one[:LINES_LIMIT]]
    numbers = [
        count(sum(reported.severity is severity for _, reported in findings), _COMMAND[severity])
        for severity in Severity
    ]
    lines.append(f"{and_list(numbers)} in all; GitHub shows the first ten of each")
    lines += [_uncommanding(f"{summary.name}: {sentence(summary)}") for summary in report.packages]
    return "\n".join(lines) + "\n"


def _annotation(reported: ReportedFinding, package: PackageReport) -> str:
    place = reported.places[0]
    properties: dict[str, str | int] = {"file": path_of(place, package)}
    if place.file:
        properties["line"] = place.line
        # Columns are for stretches of one line only.
        if place.end_line > place.line:
            properties["endLine"] = place.end_line
        else:
            properties |= {"col": place.column, "endLine": place.line}
            properties["endColumn"] = max(place.column, place.end_column)
    properties["title"] = f"{reported.rule} {reported.name}"
    return _command(_COMMAND[reported.severity], properties, "\n".join(_words(reported)))


def _words(reported: ReportedFinding) -> Iterator[str]:
    yield plain(shortened(reported.message, MESSAGE_LIMIT))
    if repeats := sum(not place.note for place in reported.places[1:]):
        yield f"also in {count(repeats, 'more place')}"
    if reported.also:
        yield f"also {', '.join(reported.also)}"
    if reported.how:
        yield f"fix: {plain(reported.how)}"
    yield reported.help


def _command(name: str, properties: Mapping[str, str | int], message: str) -> str:
    options = ",".join(f"{key}={_property(plain(str(value)))}" for key, value in properties.items())
    return f"::{name} {options}::{_data(message)}"


def _data(text: str) -> str:
    """Escape a message as GitHub's runner reads it."""
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    """Escape a property's value: what would end it too."""
    return _data(text).replace(":", "%3A").replace(",", "%2C")


def _uncommanding(line: str) -> str:
    """Return a line of text in which the runner sees no command, of its older form neither."""
    return "subt-check: " + plain(line).replace("##[", "## [")
