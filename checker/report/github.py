"""The report as workflow commands, which GitHub Actions turns into annotations of lines."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from checker.base.words import count, listed, plain, shortened
from checker.finding import Severity
from checker.report.finding_text import MESSAGE_LIMIT, path_of
from checker.report.ownership import each_once
from checker.report.report import PackageReport, Report, ReportedFinding
from checker.report.verdict import sentence

LINES_LIMIT = 50
"""Annotations of one severity; GitHub shows ten of each a step and fifty a job."""

_COMMAND = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}


def to_github(report: Report) -> str:
    """Return one workflow command a line, the gravest first; then counts and verdicts."""
    found = list(each_once(report))
    lines = [
        _command("error", {"title": "not opened"}, plain(f"{each.path} {each.reason}"))
        for each in report.not_opened
        if each.failed
    ]
    for severity in Severity:
        of_one = [(package, each) for package, each in found if each.severity is severity]
        lines += [_annotation(each, package) for package, each in of_one[:LINES_LIMIT]]
    numbers = [
        count(sum(each.severity is severity for _, each in found), _COMMAND[severity])
        for severity in Severity
    ]
    lines.append(f"{listed(numbers)} in all; GitHub shows the first ten of each")
    lines += [_uncommanding(f"{each.name}: {sentence(each)}") for each in report.packages]
    return "\n".join(lines) + "\n"


def _annotation(each: ReportedFinding, package: PackageReport) -> str:
    place = each.places[0]
    properties: dict[str, str | int] = {"file": path_of(place, package)}
    if place.file:
        properties["line"] = place.line
        # Columns are for stretches of one line only.
        if place.end_line > place.line:
            properties["endLine"] = place.end_line
        else:
            properties |= {"col": place.column, "endLine": place.line}
            properties["endColumn"] = max(place.column, place.end_column)
    properties["title"] = f"{each.rule} {each.name}"
    return _command(_COMMAND[each.severity], properties, "\n".join(_words(each)))


def _words(each: ReportedFinding) -> Iterator[str]:
    yield plain(shortened(each.message, MESSAGE_LIMIT))
    if repeats := sum(not place.note for place in each.places[1:]):
        yield f"also in {count(repeats, 'more place')}"
    if each.how:
        yield f"fix: {plain(each.how)}"
    yield each.help


def _command(name: str, properties: Mapping[str, str | int], message: str) -> str:
    said = ",".join(f"{key}={_property(plain(str(value)))}" for key, value in properties.items())
    return f"::{name} {said}::{_data(message)}"


def _data(text: str) -> str:
    """Escape a message as GitHub's runner reads it."""
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    """Escape a property's value: what would end it as well."""
    return _data(text).replace(":", "%3A").replace(",", "%2C")


def _uncommanding(line: str) -> str:
    """Return a line of text in which the runner sees no command, of its older form neither."""
    return "subt-check: " + plain(line).replace("##[", "## [")
