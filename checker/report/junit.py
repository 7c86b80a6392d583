"""The report as JUnit XML, which build servers read: a suite per package, a case per rule."""

from __future__ import annotations

import re
from collections.abc import Sequence
from xml.etree import ElementTree as ET

from checker.base.words import count, plain, shortened
from checker.report.finding_text import path_of
from checker.report.report import Cause, NotChecked, PackageReport, Report, ReportedFinding

FINDINGS_LIMIT = 100
"""Findings of one rule that are written out; the rest is counted."""

_NOT_XML = re.compile("[\ufffe\uffff]")


def to_junit(report: Report) -> str:
    """Return the report in the dialect that Jenkins' XSD describes."""
    suites = ET.Element("testsuites", name="subt-check")
    suites.extend(_suite(package) for package in report.packages)
    suites.extend(_unopened(each.path, each.reason) for each in report.not_opened if each.failed)
    for kind in ("tests", "failures", "errors"):
        suites.set(kind, str(sum(int(suite.get(kind, "0")) for suite in suites)))
    ET.indent(suites)
    written: str = ET.tostring(suites, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{written}\n'


def _xml(text: str) -> str:
    """Replace what XML cannot hold, even escaped."""
    return _NOT_XML.sub("\N{REPLACEMENT CHARACTER}", plain(text))


def _suite(package: PackageReport) -> ET.Element:
    found: dict[str, list[ReportedFinding]] = {}
    for each in package.findings:
        found.setdefault(each.rule, []).append(each)
    unseen: dict[str, list[NotChecked]] = {}
    for missing in package.not_checked:
        unseen.setdefault(missing.rule, []).append(missing)
    rules = sorted({*package.looked, *found, *unseen})
    cases = [_case(rule, package, found.get(rule, ()), unseen.get(rule, ())) for rule in rules]
    return _counted(package.name, cases, sum(package.timings.values()))


def _unopened(path: str, reason: str) -> ET.Element:
    case = ET.Element("testcase", classname=_xml(path), name="open")
    ET.SubElement(case, "error", message=_xml(f"{path} {reason}"), type="not opened")
    return _counted(path, [case], 0.0)


def _counted(name: str, cases: Sequence[ET.Element], seconds: float) -> ET.Element:
    """Return the suite of some cases; each counts for the gravest thing in it."""
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
    found: Sequence[ReportedFinding],
    unseen: Sequence[NotChecked],
) -> ET.Element:
    """Return a case; its name is the rule's id alone, so that its history is one over time."""
    case = ET.Element("testcase", classname=_xml(package.name), name=_xml(rule))
    failing = [each for each in found if each.severity.rank <= package.fail_on.rank]
    lesser = [each for each in found if each.severity.rank > package.fail_on.rank]
    reasons = "; ".join(dict.fromkeys(each.reason for each in unseen))
    if any(each.cause is Cause.CRASHED for each in unseen):
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
    lines = [_line(each, package) for each in findings[:FINDINGS_LIMIT]]
    if len(findings) > FINDINGS_LIMIT:
        lines.append(f"… and {count(len(findings) - FINDINGS_LIMIT, 'more finding')}")
    first = findings[0]
    lines += [f"why: {_xml(first.why)}"] * bool(first.why)
    lines += [f"fix: {_xml(first.how)}"] * bool(first.how)
    return "\n".join([*lines, first.help]) + "\n"


def _line(each: ReportedFinding, package: PackageReport) -> str:
    place = each.places[0]
    where = path_of(place, package) + (f":{place.line}:{place.column}" if place.file else "/")
    repeats = sum(not other.note for other in each.places[1:])
    more = f" (and {count(repeats, 'more place')})" if repeats else ""
    message = shortened(each.message, 600)
    return _xml(f"{where} {each.severity} {each.rule} {each.name}: {message}{more}")
