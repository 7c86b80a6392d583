"""The profile `sdf`: what the SDFormat specification forbids is an error, what it allows is none.

Each file of `sdf_files/invalid` breaks the one sentence at its top. A marker `^ SDF005` stands on
the line that must be reported. The files of `sdf_files/valid` show at their top what is allowed;
those of `sdf_files/tolerated` break a sentence, and load all the same: that is a warning or less.
"""

from __future__ import annotations

import re
from collections.abc import Set
from pathlib import Path

import pytest

from checker.cli.exit_code import exit_code
from checker.formats.sdf.schema import VERSIONS
from checker.pipeline import check_package
from checker.report.report import Cause, Report
from checker.rule import Severity
from checker.rulebook.discovery import all_rules
from checker.settings import Settings

FILES = Path(__file__).parent / "sdf_files"
VALID = sorted((FILES / "valid").glob("*.sdf"))
INVALID = sorted((FILES / "invalid").glob("*.sdf"))
TOLERATED = sorted((FILES / "tolerated").glob("*.sdf"))

_MARKER = re.compile(r"\^ ([A-Z][A-Z0-9]{2}\d{3})")


def checked(file: Path) -> Report:
    return check_package(file, Settings(profile="sdf"))


def errors(report: Report, severity: Severity = Severity.ERROR) -> Set[tuple[str, int]]:
    """Return rule and line of each error, or of each finding of another severity."""
    (package,) = report.packages
    return {
        (finding.rule, place.line)
        for finding in package.findings
        if finding.severity is severity
        for place in finding.places
        if not place.note
    }


def marked(file: Path) -> Set[tuple[str, int]]:
    lines = file.read_text("utf-8").splitlines()
    return {(rule, n) for n, line in enumerate(lines, 1) for rule in _MARKER.findall(line)}


@pytest.mark.parametrize("file", VALID, ids=lambda file: file.stem)
def test_what_the_specification_allows_is_no_error(file: Path) -> None:
    report = checked(file)
    assert errors(report) == set()
    (package,) = report.packages
    assert not [each for each in package.not_checked if each.cause is Cause.CRASHED]
    assert not marked(file)


@pytest.mark.parametrize("file", INVALID, ids=lambda file: file.stem)
def test_what_the_specification_forbids_is_reported_at_its_line(file: Path) -> None:
    report = checked(file)
    assert errors(report) == marked(file)
    assert len(marked(file)) == 1
    assert exit_code(report) == 1


@pytest.mark.parametrize("file", TOLERATED, ids=lambda file: file.stem)
def test_what_loads_against_the_specification_is_no_error(file: Path) -> None:
    report = checked(file)
    assert errors(report) == set()
    assert errors(report, Severity.WARNING) | errors(report, Severity.INFO) >= marked(file)
    assert len(marked(file)) == 1


def test_each_file_says_what_it_is_about() -> None:
    for file in (*VALID, *INVALID, *TOLERATED):
        first = file.read_text("utf-8").splitlines()[0]
        assert re.fullmatch(r"<!-- [^<>^]{10,}\. -->", first), file.name


def test_there_are_valid_files_of_every_version() -> None:
    texts = [file.read_text("utf-8") for file in VALID]
    assert {v for v in VERSIONS if any(f'<sdf version="{v}">' in t for t in texts)} == set(VERSIONS)


def test_there_are_invalid_files_for_every_rule_on_syntax_that_gives_errors() -> None:
    rules = {rule.id for rule in all_rules() if rule.group == "SDF"}
    never_errors = {
        "SDF003",
        "SDF004",
        "SDF007",
        "SDF008",
        "SDF010",
        "SDF011",
        "SDF013",
        "SDF014",
        "SDF015",
        "SDF019",
    }
    assert {rule for file in INVALID for rule, _ in marked(file)} >= rules - never_errors


def test_all_faults_of_a_file_are_reported_in_one_run(tmp_path: Path) -> None:
    file = tmp_path / "many.sdf"
    file.write_text(
        """<sdf version="1.8">
  <model name="robot">
    <link name="body"><pose>0 0</pose></link>
    <link name="body"/>
    <frame name="top" attached_to="roof"/>
    <joint name="hinge" type="hinge">
      <parent>body</parent>
      <child>lid</child>
    </joint>
    <static>perhaps</static>
  </model>
</sdf>
""",
        "utf-8",
    )
    expected = {("SDF006", 3), ("SDF009", 4), ("KIN010", 5), ("KIN008", 6), ("KIN001", 8)}
    assert errors(checked(file)) == expected | {("SDF006", 10)}
