"""The report as a comment on a pull request: Markdown as GitHub reads it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from checker.base.words import count, shortened
from checker.finding import Severity
from checker.report.figures import facts_in_words
from checker.report.finding_text import path_of
from checker.report.markdown_text import T, code, escaped, fitting, with_code
from checker.report.ownership import each_once
from checker.report.report import (
    Cause,
    NotOpened,
    PackageReport,
    Report,
    ReportedFinding,
    Suppressed,
)
from checker.report.robots import ReportedRobot, robots_of
from checker.report.summary import ready_of_all, sentence, summary_markdown
from checker.report.unseen import Unseen, by_reason

SIZE_LIMIT = 65_000
"""Bytes; GitHub takes comments of up to 65 536 characters."""

_PACKAGES_ROOM, _FINDINGS_ROOM, _DETAILS_ROOM = 10_000, 28_000, 5_000
_TEXT_LIMIT = 300


def to_markdown(report: Report) -> str:
    """Return verdicts, a table of findings, and the rest folded; below `SIZE_LIMIT`."""
    findings = sorted(each_once(report), key=lambda pair: pair[1].severity.rank)
    pages = {
        reported.rule: reported
        for _, reported in findings
        if reported.severity is not Severity.INFO
    }
    blocks = [
        *_verdicts(report),
        _findings(findings),
        _folded("Why, and how to fix it", list(pages.values()), _page),
        _folded("Suppressed", _pairs(report, lambda package: package.suppressed), _aside),
        _folded("Not checked", _pairs(report, _unseen), _unseen_line),
        _folded("Facts", _pairs(report, _robots), _robot_line),
    ]
    return "\n\n".join(filter(None, blocks)) + "\n"


def _verdicts(report: Report) -> Iterator[str]:
    if len(report.packages) > 1:
        yield f"## {ready_of_all(report.packages)}"
        table, left = summary_markdown(report.packages, _PACKAGES_ROOM)
        yield table + _remainder(left, "package")
    for package in report.packages if len(report.packages) == 1 else ():
        verdict, name = sentence(package), _short(package.name)
        aside = f" ({escaped(verdict.aside)})" if verdict.aside else ""
        yield f"## {name}: {verdict.lead}"
        yield f"{escaped(verdict.rest)}{aside}"
    unopened = [item for item in report.not_opened if item.failed]
    rows, left = fitting(unopened, _unopened, _DETAILS_ROOM)
    yield "\n".join(rows) + _remainder(left, "path")


def _unopened(item: NotOpened) -> str:
    return f"- {code(shortened(item.path, _TEXT_LIMIT))}: {_short(item.reason)}"


def _findings(findings: Sequence[tuple[PackageReport, ReportedFinding]]) -> str:
    rows, left = fitting(findings, _row, _FINDINGS_ROOM)
    if not rows:
        return ""
    head = ["| severity | rule | place | what |", "|---|---|---|---|"]
    return "\n".join([*head, *rows]) + _remainder(left, "finding", "; `--format json` lists all")


def _row(pair: tuple[PackageReport, ReportedFinding]) -> str:
    package, reported = pair
    place = reported.places[0]
    path = path_of(place, package)
    where = code(f"…{path[-200:]}" if len(path) > 200 else path)
    line = f" line {place.line}" if place.file else ""
    repeats = sum(not other.note for other in reported.places[1:])
    more = f" (and {count(repeats, 'more place')})" if repeats else ""
    rule = f"{reported.rule} {_short(reported.name)}"
    rule += f" (also {', '.join(reported.also)})" if reported.also else ""
    return f"| {reported.severity} | {rule} | {where}{line} | {_short(reported.message)}{more} |"


def _page(reported: ReportedFinding) -> str:
    how = f" **Fix:** {with_code(reported.how)}" if reported.how else ""
    return f"- **{reported.rule}** {with_code(reported.why)}{how}"


def _pairs(report: Report, items_of: Callable[[PackageReport], Iterable[T]]) -> list[tuple[str, T]]:
    """Return things of packages, each with its package's name where there are several."""
    several = len(report.packages) > 1
    return [
        (package.name if several else "", item)
        for package in report.packages
        for item in items_of(package)
    ]


def _begin(name: str) -> str:
    return f"- **{_short(name)}**: " if name else "- "


def _aside(pair: tuple[str, Suppressed]) -> str:
    name, suppressed = pair
    text = f"{suppressed.finding.rule} {_short(suppressed.finding.message)}"
    return f"{_begin(name)}{text} ({suppressed.by}: {_short(suppressed.reason)})"


def _unseen(package: PackageReport) -> Iterable[Unseen]:
    """Return reasons, each with the rules that it kept from looking."""
    shown = (it for it in package.not_checked if it.cause is not Cause.NOT_APPLICABLE)
    return by_reason(shown)


def _unseen_line(pair: tuple[str, Unseen]) -> str:
    name, unseen = pair
    return f"{_begin(name)}{_short(', '.join(unseen.rules))}: {_short(unseen.reason)}"


def _robots(package: PackageReport) -> Iterable[ReportedRobot]:
    return [robot for robot in robots_of(package) if robot.facts]


def _robot_line(pair: tuple[str, ReportedRobot]) -> str:
    name, robot = pair
    phrases = [fact.phrase for fact in facts_in_words(robot.facts)]
    phrases += [f"trial {robot.verdict}"] if robot.verdict.word else []
    return _begin(name) + _short(", ".join(phrases))


def _folded(title: str, items: Sequence[T], line: Callable[[T], str]) -> str:
    rows, left = fitting(items, line, _DETAILS_ROOM)
    if not rows:
        return ""
    body = "\n".join(rows) + _remainder(left, "line")
    return f"<details><summary>{title}</summary>\n\n{body}\n\n</details>"


def _remainder(number: int, noun: str, end: str = "") -> str:
    return f"\n\nand {count(number, f'more {noun}')}{end}" if number else ""


def _short(text: str) -> str:
    return escaped(shortened(text, _TEXT_LIMIT))
