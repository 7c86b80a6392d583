"""A package with several robots: every report tells of each of them and of its trial."""

from __future__ import annotations

from typing import Any

import pytest
from lxml import html
from msgspec.structs import replace

from checker.finding import Concern, Place, Severity
from checker.report.html.page import to_html
from checker.report.json_report import report_from_json, to_json
from checker.report.markdown import to_markdown
from checker.report.render_settings import Palette, RenderSettings
from checker.report.report import PackageReport, Report, ReportedFinding
from checker.report.robots import robots_of
from checker.report.text_report import to_text
from tests.report.html.test_page import HOSTILE, skeleton
from tests.report.test_trial_text import figure, trial


def facts(name: str, **more: Any) -> dict[str, Any]:
    said = {"robot": name, "mass_kg": 2.0, "links": 3, "drive": "skid-steer drive"}
    return {**said, "file": f"urdf/{name}.urdf", **more}


SLOW = figure("speed_ratio", 0.2, verdict="error", limits={"warning_beyond": 0.05})
PACKAGE = PackageReport(
    "fleet",
    "fleet",
    "urdf_description",
    (),
    facts=facts("ant"),
    trial=trial(figure("speed_ratio", 0.99), robot=0),
    other_robots=(
        facts("bee", not_driven="the model is static"),
        facts("cat"),
        facts("dog"),
    ),
    other_trials=(trial(SLOW, robot=2), trial(robot=3, not_driven="its plugins drive no part")),
)
REPORT = Report((PACKAGE,), {})
VERDICTS = [
    "ok",
    "not driven: the model is static",
    "error",
    "not driven: its plugins drive no part",
]


def page(package: PackageReport = PACKAGE) -> html.HtmlElement:
    manner = RenderSettings(Palette(enabled=False), "/work")
    return html.fromstring(to_html(package, Report((package,), {}), manner))


def words(element: html.HtmlElement) -> str:
    return " ".join(element.text_content().split())


def test_each_robot_has_the_verdict_of_its_own_trial() -> None:
    assert [str(robot.verdict) for robot in robots_of(PACKAGE)] == VERDICTS


def test_json_keeps_them_apart() -> None:
    again = report_from_json(to_json(REPORT))
    assert [str(robot.verdict) for robot in robots_of(again.packages[0])] == VERDICTS


def test_a_terminal_shows_a_line_for_each_and_what_is_wrong() -> None:
    lines = to_text(REPORT, RenderSettings(Palette(enabled=False))).splitlines()
    told = [line for line in lines if line.startswith("robot ")]
    assert [line.partition(", trial ")[2] for line in told] == VERDICTS
    assert lines[lines.index(told[2]) + 1] == "    speed ratio  0.2  error  ok from 0.95 to 1.05"


def test_a_comment_has_a_line_for_each() -> None:
    told = [line for line in to_markdown(REPORT).splitlines() if line.startswith("- robot ")]
    assert [line.partition(", trial ")[2] for line in told] == VERDICTS


def test_the_page_lists_them_before_the_findings() -> None:
    tree = page()
    sections = tree.xpath("//main/section/@id")
    assert sections.index("robots") < sections.index("findings")
    rows = [
        [words(cell) for cell in row.xpath("th|td")]
        for row in tree.xpath("//section[@id='robots']//tbody/tr")
    ]
    assert rows == [
        [f"{name}urdf/{name}.urdf", verdict, "skid-steer drive", "2 kg", "3"]
        for name, verdict in zip(("ant", "bee", "cat", "dog"), VERDICTS, strict=True)
    ]


def test_the_page_leads_from_each_robot_to_its_trial() -> None:
    tree = page()
    anchors = tree.xpath("//section[@id='robots']//a/@href")
    assert anchors == ["#trial-1", "#trial-3", "#trial-4"]
    assert [f"#{name}" for name in tree.xpath("//section[@id='trial']/details/@id")] == anchors
    slow = tree.xpath("//details[@id='trial-3']")[0]
    assert "0.2" in words(slow)
    assert "cat skid-steer drive error" in words(slow.find("summary"))


def test_one_robot_needs_no_table() -> None:
    alone = replace(PACKAGE, other_robots=(), other_trials=())
    tree = page(alone)
    assert not tree.xpath("//section[@id='robots']")
    assert not tree.xpath("//section[@id='trial']//details")
    assert "speed ratio" in words(tree.xpath("//section[@id='trial']")[0])


def test_a_part_of_a_robot_that_is_not_in_view_leads_to_no_part_of_another() -> None:
    found = tuple(
        ReportedFinding(
            "GEO001", "imprecise-angle", Severity.WARNING, Concern.ROBOT, "wrong", f"{number:016x}",
            (Place(f"urdf/{name}.urdf", 1, 1, 1, 2, "robot/link[wheel]"),),
        )
        for number, name in enumerate(("ant", "cat"))
    )  # fmt: skip
    tree = page(replace(PACKAGE, findings=found))
    elements = tree.xpath("//article/@data-elements")
    assert elements == ["robot/link[wheel]", ""]


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_names_stay_text(text: str) -> None:
    def named(name: str) -> PackageReport:
        further = (facts(name, file=name, not_driven=name), facts(name, drive=name))
        return replace(PACKAGE, other_robots=further, other_trials=(trial(SLOW, robot=2),))

    assert skeleton(page(named(text))) == skeleton(page(named("harmless")))


def test_a_refused_model_has_its_reason_in_its_place() -> None:
    refused = trial(robot=2, refused="mass is 0")
    package = replace(PACKAGE, other_trials=(refused,))
    assert str(robots_of(package)[2].verdict) == "error: MuJoCo refuses the model"
    assert "mass is 0" in words(page(package).xpath("//details[@id='trial-3']")[0])
    assert "MuJoCo refuses the model" in to_text(
        Report((package,), {}), RenderSettings(Palette(enabled=False))
    )
