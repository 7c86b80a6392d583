"""The page of a package: complete, escaped, bounded."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import html
from msgspec.structs import replace

from checker.base.words import plain
from checker.finding import Concern, Edit, Fix, Place, Safety, Severity
from checker.report.files import artefacts
from checker.report.html.page import to_html, to_index, with_code
from checker.report.render_settings import Palette, RenderSettings
from checker.report.report import (
    Cause,
    InheritedPart,
    NotChecked,
    NotOpened,
    PackageReport,
    Report,
    ReportedFinding,
    Suppressed,
    SuppressedBy,
)

HOSTILE = [
    "</script><script>alert(1)</script>",
    "\"><img src=x onerror=alert(1)>",
    "'; alert(1); '",
    "{{ 7*7 }}{% for x in y %}",
    "🤖 \u202eevil\u202c \u0000\u001b[31m",
    "<!-- -->]]>",
    "</style><style>*{display:none}",
    "javascript:alert(1)",
]  # fmt: skip
VERSIONS = {"subt-check": "1.0", "mujoco": "4.0"}


def finding(text: str, number: int = 0) -> ReportedFinding:
    place = Place(f"{text}.sdf", 3, 1, 3, 4, f"sdf/model[{text}]", text, f"  {text}")
    fix = Fix(Safety.UNSAFE, (Edit(place, text, text[:3]),))
    severity = list(Severity)[number % 3]
    fingerprint = f"{number:016x}"
    return ReportedFinding(
        "SEN005", "lidar-scan-resolution", severity, Concern.INTERFACE, text,
        fingerprint, (place, place),
        fix, "Why.", "write `1`.",
    )  # fmt: skip


def package(text: str, findings: int = 1) -> PackageReport:
    found = tuple(finding(text, number) for number in range(findings))
    return PackageReport(
        text, f"models/{text}", "robot", found,
        (NotChecked("SEN001", text, Cause.NOT_AT_HAND),),
        facts={"robot": text, "mass_kg": 2.0}, settings=text,
        suppressed=(Suppressed(finding(text), SuppressedBy.COMMENT, text, None),),
    )  # fmt: skip


def rendered(package: PackageReport, command: str = "") -> str:
    manner = RenderSettings(Palette(enabled=False), "/work", command)
    return to_html(package, Report((package,), VERSIONS), manner)


def page(report: PackageReport) -> html.HtmlElement:
    return html.fromstring(rendered(report))


def skeleton(tree: html.HtmlElement) -> list[tuple[str, tuple[str, ...]]]:
    """Return tags and names of attributes: what no text may change, lines of a patch aside."""
    return [
        (str(each.tag), tuple(sorted(each.attrib)))
        for each in tree.iter()
        if each.tag not in ("ins", "del")
    ]


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_text_stays_text(text: str) -> None:
    tree = page(package(text))
    assert skeleton(tree) == skeleton(page(package("harmless")))
    assert plain(text) in tree.findtext(".//h1/bdi")


@given(st.text(min_size=1, max_size=60))
def test_any_text_leaves_the_page_as_it_is(text: str) -> None:
    assert skeleton(page(package(f"a{text}"))) == skeleton(page(package("harmless")))


def test_nothing_is_asked_for_outside() -> None:
    said = rendered(package("rover"))
    assert not re.search(r"""(?:src|href)=["']?(?:https?:)?//""", said)
    policy = page(package("rover")).xpath("//meta[@http-equiv]/@content")[0]
    assert policy.startswith("default-src 'none'")
    assert "unsafe-eval" not in policy


@pytest.mark.slow
def test_ten_thousand_findings_are_capped_and_counted() -> None:
    report = package("rover", findings=10_000)
    said = rendered(report)
    tree = html.fromstring(said)
    assert len(said) < 5_000_000
    shown = len(tree.xpath("//article[contains(@class, 'finding')]"))
    hidden = sum(map(int, re.findall(r"and (\d+) more findings of this severity", said)))
    assert shown + hidden == 10_000
    assert "3334 errors" in said


def test_findings_stand_by_severity_and_concern_and_then_by_place() -> None:
    def at(line: int, severity: Severity, concern: Concern) -> ReportedFinding:
        place = Place("model.sdf", line, 1, line, 2)
        own = replace(finding("a", line), severity=severity, concern=concern, places=(place,))
        return replace(own, message=f"line {line}")

    found = (
        at(1, Severity.INFO, Concern.ROBOT),
        at(2, Severity.ERROR, Concern.PAPERWORK),
        at(4, Severity.ERROR, Concern.ROBOT),
        at(3, Severity.ERROR, Concern.ROBOT),
        at(5, Severity.WARNING, Concern.INTERFACE),
    )
    tree = page(replace(package("rover"), findings=found))
    said = tree.xpath("//article//h4/bdi/text()")
    assert said == ["line 3", "line 4", "line 2", "line 5", "line 1"]
    assert tree.xpath("//details[@data-severity='info']//h4/bdi/text()") == ["line 1"]
    assert tree.xpath("//ol[@class='tasks']/li/a/bdi/text()") == ["line 3", "line 5"]


def test_each_finding_leads_to_its_rule_and_to_itself() -> None:
    tree = page(package("rover", findings=3))
    anchors = set(tree.xpath("//@id"))
    links = tree.xpath("//article//a/@href | //ol[@class='tasks']//a/@href")
    assert len(links) > 6
    assert {link.removeprefix("#") for link in links} <= anchors
    assert "Why." in tree.xpath("//*[@id='rule-SEN005']")[0].text_content()


def test_the_message_comes_before_place_patch_and_why() -> None:
    (article,) = page(package("rover")).xpath("//article")
    parts = [each.get("class", each.tag).split()[0] for each in article]
    assert parts == ["message", "place", "frame", "also", "patch", "why", "about"]


def test_what_could_not_be_checked_is_the_first_thing_to_do_of_an_incomplete_package() -> None:
    unseen = NotChecked("SEN001", "model.sdf is not available", Cause.NOT_AT_HAND)
    tree = page(replace(package("rover"), findings=(), not_checked=(unseen,)))
    (task,) = tree.xpath("//ol[@class='tasks']/li/a")
    assert task.get("href") == "#not-checked"
    assert task.text_content() == "1 rule could not run: model.sdf is not available"


def test_a_page_leads_back_to_the_list_it_belongs_to() -> None:
    manner = RenderSettings(Palette(enabled=False), "/work")
    report = Report((package("a"), package("b")), VERSIONS)
    files = {name: text for name, text in artefacts(report, manner) if name.endswith(".html")}
    assert set(files) == {"a/report.html", "b/report.html", "index.html"}
    assert html.fromstring(files["a/report.html"]).xpath("//header//a/@href") == ["../index.html"]
    alone = dict(artefacts(Report((package("a"),), VERSIONS), manner))
    assert not html.fromstring(alone["report.html"]).xpath("//header//a")


def test_the_index_counts_what_several_packages_have() -> None:
    report = Report((package("a"), package("b"), replace(package("c"), findings=())), VERSIONS)
    tree = html.fromstring(to_index(report, ["a.html", "b.html", "c.html"]))
    (common,) = tree.xpath("//section[@aria-labelledby='common-title']//details")
    assert "in 2 of 3" in common.findtext("summary/span[@class='aside']")
    (print_a, print_b) = common.xpath(".//li/a/@href")
    assert print_a == f"a.html#f-{0:016x}"
    assert print_b.startswith("b.html#f-")


def test_backticks_of_a_page_are_code() -> None:
    assert with_code("write `<a>` & go") == "write <code>&lt;a&gt;</code> &amp; go"
    assert with_code("one ` alone <") == "one ` alone &lt;"


def test_downloads_hold_the_report() -> None:
    tree = page(package("rover"))
    names = tree.xpath("//a[@download]/@download")
    assert names == ["report.json", "report.sarif"]


@pytest.mark.parametrize("text", HOSTILE)
def test_the_index_lists_every_package(text: str) -> None:
    report = Report(
        (package(text), replace(package("b"), findings=())), VERSIONS,
        (NotOpened(text, "is nothing", failed=True),),
    )  # fmt: skip
    tree = html.fromstring(to_index(report, ["", "b/report.html"]))
    assert tree.xpath("//tbody//a/@href") == ["b/report.html"]
    assert tree.xpath("//tbody//th/bdi/text()")[0] == plain(text)
    assert "0 of 2 packages ready" in tree.findtext(".//title")


def test_the_command_is_repeated_as_it_was() -> None:
    said = rendered(package("rover"), "subt-check './a b' --select SEN")
    assert html.fromstring(said).findtext(".//pre/code") == "subt-check './a b' --select SEN"
    assert "To check again" not in rendered(package("rover"))


def test_a_name_that_is_no_text_spoils_no_patch() -> None:
    tree = page(replace(package("rover"), patch="--- a/\udcff\n"))
    assert "fixes.patch" in tree.xpath("//a[@download]/@download")


def test_it_says_why_nothing_was_driven() -> None:
    unseen = NotChecked("TRI001", "the model has no links", Cause.NOT_APPLICABLE)
    other = NotChecked("PKG001", "switched off", Cause.SWITCHED_OFF)
    tree = page(replace(package("rover"), not_checked=(other, unseen)))
    said = " ".join(tree.xpath("//section[@id='trial']//text()"))
    assert "Not driven: the model has no links" in said
    assert "switched off" not in said


def test_lists_say_what_they_leave_out() -> None:
    reasons = tuple(NotChecked(f"A{n:03}", f"reason {n}", Cause.NOT_AT_HAND) for n in range(400))
    aside = package("rover").suppressed * 500
    said = rendered(replace(package("rover"), not_checked=reasons, suppressed=aside))
    assert "and 100 more reasons" in said
    assert "and 200 more findings" in said


def test_inherited_parts_are_named_without_a_robot() -> None:
    parts = (InheritedPart("model.sdf", "rover_sensor_config_1", at_hand=False),)
    tree = page(replace(package("rover"), facts={}, inherited=parts))
    said = " ".join(" ".join(tree.xpath("//section[@id='facts']//text()")).split())
    assert "inherited from rover_sensor_config_1 (not found)" in said


def test_what_was_not_opened_is_named() -> None:
    report = Report(
        (package("rover"),), VERSIONS, (NotOpened("nothere", "is missing", failed=True),)
    )
    settings = RenderSettings(Palette(enabled=False), "/work")
    assert "nothere" in to_html(report.packages[0], report, settings)
    # One of several packages leaves it to the list of all.
    assert "nothere" not in to_html(report.packages[0], report, settings, "../index.html")
