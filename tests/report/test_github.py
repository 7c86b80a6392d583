"""Workflow commands: GitHub's runner reads back what was meant, and nothing else."""

from __future__ import annotations

import re

from hypothesis import given
from msgspec.structs import replace

from checker.finding import Place, Severity
from checker.report.ci_formats import LINES_LIMIT, to_github
from checker.report.report import NotOpened, Report
from tests.report.any_report import REPORTS, many

(PACKAGE,) = many(1).packages
FAULT = replace(PACKAGE.findings[0], message="50% of a,b:c")
Command = tuple[str, dict[str, str], str]


def read(line: str) -> Command:
    """Read a workflow command as the runner does: name, properties, message."""
    found = re.fullmatch(r"::(\w+) ([^:]*)::(.*)", line)
    assert found, line
    name, properties, message = found.groups()
    pairs = (each.split("=", 1) for each in properties.split(","))
    return name, {key: unescaped(value) for key, value in pairs}, unescaped(message)


def unescaped(text: str) -> str:
    for code, mark in (("%0D", "\r"), ("%0A", "\n"), ("%3A", ":"), ("%2C", ","), ("%25", "%")):
        text = text.replace(code, mark)
    return text


def lines(report: Report) -> list[str]:
    written = to_github(report)
    assert written.endswith("\n")
    return written[:-1].split("\n")


def commands(report: Report) -> list[Command]:
    """Return the commands in a report; they stand before everything else."""
    said = lines(report)
    found = [read(line) for line in said if line.startswith("::")]
    assert all(line.startswith("::") for line in said[: len(found)])
    return found


def test_a_finding_is_a_command_with_its_place() -> None:
    place = Place("a,b:c%.sdf", 3, 5, 3, 9)
    finding = replace(FAULT, places=(place, place, place))
    report = Report((replace(PACKAGE, findings=(finding,)),), {})
    assert commands(report) == [
        (
            "error",
            {
                "file": "models/rover/a,b:c%.sdf",
                "line": "3",
                "col": "5",
                "endLine": "3",
                "endColumn": "9",
                "title": "SDF004 unknown-element",
            },
            "50% of a,b:c\nalso in 2 more places\nfix: take it out.\nsubt-check rule SDF004",
        )
    ]
    assert lines(report)[0].startswith("::error file=models/rover/a%2Cb%3Ac%25.sdf,line=3,")


def test_columns_are_for_one_line_and_lines_for_files() -> None:
    for place, keys in (
        (Place("a", 3, 5, 4, 9), ["file", "line", "endLine", "title"]),
        (Place(""), ["file", "title"]),
    ):
        finding = replace(FAULT, places=(place,))
        ((_, properties, _),) = commands(Report((replace(PACKAGE, findings=(finding,)),), {}))
        assert list(properties) == keys


def test_the_gravest_come_first_and_the_rest_is_counted() -> None:
    kinds = (Severity.INFO, Severity.ERROR, Severity.WARNING)
    findings = tuple(replace(FAULT, severity=kind) for kind in kinds for _ in range(60))
    report = Report((replace(PACKAGE, findings=findings),), {})
    names = [name for name, _, _ in commands(report)]
    assert names == [n for n in ("error", "warning", "notice") for _ in range(LINES_LIMIT)]
    assert lines(report)[-2:] == [
        "60 errors, 60 warnings and 60 notices in all; GitHub shows the first ten of each",
        "subt-check: rover: Not ready: 60 errors of portability to fix, 60 warnings",
    ]


def test_what_was_not_opened_is_an_error() -> None:
    missing = NotOpened("nowhere", "does not exist", failed=True)
    assert commands(Report((), {}, (missing,))) == [
        ("error", {"title": "not opened"}, "nowhere does not exist")
    ]


def test_no_name_is_a_command() -> None:
    for name in ("::error::x", "##[error]x", " ::stop-commands::x", "a\n::error::x"):
        *_, verdict = lines(Report((replace(PACKAGE, name=name),), {}))
        assert verdict.startswith("subt-check: ")
        assert "##[" not in verdict


@given(REPORTS)
def test_any_report_is_read_back(report: Report) -> None:
    said = lines(report)
    found = commands(report)
    failed = sum(each.failed for each in report.not_opened)
    assert len(found) <= failed + sum(len(each.findings) for each in report.packages)
    assert len(said) == len(found) + 1 + len(report.packages)
    for name, properties, _ in found:
        assert name in ("error", "warning", "notice")
        known = {"file", "line", "col", "endLine", "endColumn", "title"}
        assert set(properties) <= known
    assert "##[" not in "".join(said[len(found) :])
