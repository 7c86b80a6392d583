"""Tables over many packages and many rules."""

from __future__ import annotations

import re

import pytest
from msgspec.structs import replace

from checker.finding import Concern, Place, Severity
from checker.report.html.page import to_index
from checker.report.render_settings import Palette
from checker.report.report import PackageReport, Report, Suppressed, SuppressedBy
from checker.report.summary import sentence, statistics_text, summary_markdown, summary_text
from tests.report.any_report import many

(PACKAGE,) = many(3).packages
OTHER = replace(PACKAGE, name="other|one", path="models/other")
GOOD = PackageReport("good", "models/good", "robot", ())


def test_a_line_for_each_package() -> None:
    assert summary_text((GOOD, PACKAGE), Palette(enabled=False)).splitlines() == [
        "package  verdict    errors  warnings  infos",
        "good     ready           0         0      0",
        "rover    not ready       3         0      0",
        "2 packages, 1 ready",
    ]


def test_packages_of_one_name_have_their_paths() -> None:
    twins = (GOOD, replace(GOOD, path="parts/good"), PACKAGE)
    lines = summary_text(twins, Palette(enabled=False)).splitlines()
    assert [line.split()[0] for line in lines[1:4]] == ["models/good", "parts/good", "rover"]


def test_what_is_suppressed_has_a_column_where_there_is_any() -> None:
    aside = Suppressed(PACKAGE.findings[0], SuppressedBy.SETTINGS, "it is so")
    some = replace(GOOD, suppressed=(aside, aside))
    assert summary_text((some, PACKAGE), Palette(enabled=False)).splitlines() == [
        "package  verdict    errors  warnings  infos  suppressed",
        "good     ready           0         0      0           2",
        "rover    not ready       3         0      0           0",
        "2 packages, 1 ready",
    ]
    table = summary_markdown((some, PACKAGE), 1000)[0].splitlines()
    assert table[0] == "| package | verdict | errors | warnings | infos | suppressed |"
    assert table[1] == "|---|---|---:|---:|---:|---:|"
    assert [row.split("|")[-2].strip() for row in table[2:]] == ["2", "0"]
    index = to_index(Report((some, PACKAGE), {}), ())
    assert ">suppressed</th>" in index
    assert re.findall(r'<td class="figure" [^>]*>(\d+)</td>', index) == list("00023000")
    assert ">suppressed</th>" not in to_index(Report((GOOD, PACKAGE), {}), ())


@pytest.mark.parametrize(
    ("severities", "said"),
    [
        ("", "Ready: nothing to fix"),
        ("wi", "Ready: nothing to fix (2 suppressed)"),
        ("we", "Ready: nothing to fix (2 suppressed, 1 of them an error)"),
        ("wewe", "Ready: nothing to fix (4 suppressed, 2 of them errors)"),
    ],
)
def test_the_sentence_says_how_many_errors_are_suppressed(severities: str, said: str) -> None:
    by_letter = {str(severity)[0]: severity for severity in Severity}
    aside = tuple(
        Suppressed(
            replace(PACKAGE.findings[0], severity=by_letter[letter]), SuppressedBy.SETTINGS, "so"
        )
        for letter in severities
    )
    assert str(sentence(replace(GOOD, suppressed=aside))) == said


def test_a_name_ends_no_cell() -> None:
    table, left = summary_markdown((GOOD, OTHER), 1000)
    assert table.splitlines()[-1] == "| other&#124;one | not ready | 3 | 0 | 0 |"
    assert left == 0
    assert summary_markdown((GOOD, OTHER), 40)[1] == 1


def test_statistics_count_findings_and_packages_by_rule() -> None:
    first = PACKAGE.findings[0]
    warnings = tuple(
        replace(first, rule=rule, name="too-high", severity=Severity.WARNING, places=(Place(rule),))
        for rule in ("GEO002", "GEO001")
    )
    mixed = replace(OTHER, findings=(*PACKAGE.findings, *warnings))
    assert statistics_text(Report((PACKAGE, mixed, GOOD), {})).splitlines() == [
        "rule    severity  findings  packages  name",
        "SDF004  error            6         2  unknown-element",
        "GEO001  warning          1         1  too-high",
        "GEO002  warning          1         1  too-high",
    ]
    assert statistics_text(Report((GOOD,), {})) == "No findings.\n"


def test_what_packages_share_counts_once() -> None:
    shared = replace(PACKAGE.findings[0], places=(Place("../base/model.sdf"),))
    packages = [replace(GOOD, name=n, path=f"models/{n}", findings=(shared,)) for n in "ab"]
    (_, row) = statistics_text(Report(tuple(packages), {})).splitlines()
    assert row == "SDF004  error            1         1  unknown-element"


def verdict_on(*errors: tuple[Concern, str]) -> str:
    """Return the sentence about a package with errors of these concerns in these files."""
    (first, *_) = PACKAGE.findings
    findings = tuple(
        replace(first, concern=concern, places=(Place(file),)) for concern, file in errors
    )
    return str(sentence(replace(PACKAGE, findings=findings)))


def test_the_verdict_says_what_the_errors_are_about_and_where_they_are_inherited_from() -> None:
    robot, papers = Concern.ROBOT, Concern.PAPERWORK
    own, base = "model.sdf", "../base/model.sdf"
    assert verdict_on() == "Ready: nothing to fix"
    assert verdict_on((papers, own)) == (
        "Ready once the paperwork is done: 1 error of the paperwork to fix"
    )
    assert verdict_on((robot, own), (robot, own), (papers, own), (robot, base)) == (
        "Not ready: 2 errors of the robot and 1 of the paperwork to fix, and 1 in base"
    )
    assert verdict_on((robot, base), (robot, base)) == "Not ready: 2 errors to fix in base"
    assert verdict_on((robot, base), (robot, "../other/a.sdf")) == (
        "Not ready: 2 errors to fix: 1 in base and 1 in other"
    )


def test_a_package_around_is_called_by_its_name() -> None:
    far = "../../urdf/arm.urdf"
    found = replace(PACKAGE.findings[0], places=(Place(far),))
    package = replace(PACKAGE, findings=(found,), neighbours={far: "arm_description"})
    assert str(sentence(package)) == "Not ready: 1 error to fix in arm_description"
