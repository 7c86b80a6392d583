"""Sections of a sheet."""

from __future__ import annotations

from checker.model.specification.sheet import read_specification
from checker.source.text import SourceText

TEXT = """# Robot
intro

## Sensor Config Guide
guide

## Usage Rights

## Cost and Scale #
### Sensors
* 1 x IMU

# <a name="validation_links"></a>Robot Validation and Specification Links
* https://example.org
"""


def read(text: str):
    return read_specification(SourceText("specifications.md", text))


def test_sections_know_title_level_and_place():
    assert [(each.title, each.level, each.span.line) for each in read(TEXT).sections] == [
        ("Robot", 1, 1),
        ("Sensor Config Guide", 2, 4),
        ("Usage Rights", 2, 7),
        ("Cost and Scale", 2, 9),
        ("Sensors", 3, 10),
        ("Robot Validation and Specification Links", 1, 13),
    ]


def test_a_section_is_found_by_words_of_its_heading_at_any_level():
    sheet = read(TEXT)
    assert sheet.section("sensors").level == 3
    assert sheet.section("Validation and Specification Links").level == 1
    assert sheet.section("Sensor") .title == "Sensor Config Guide"  # fmt: skip
    assert sheet.section("Endurance") is None


def test_a_heading_of_just_the_words_goes_before_one_that_contains_them():
    assert read("# Control of X\na\n# Control\nb").section("control").text == "b"


def test_what_stands_in_lower_sections_belongs_to_the_higher_one():
    cost = read(TEXT).section("Cost and Scale")
    assert cost.text == "Sensors\n1 x IMU"
    assert not cost.is_empty


def test_an_empty_section_is_empty_and_one_of_bare_links_is_not():
    sheet = read(TEXT)
    assert sheet.section("Usage Rights").is_empty
    assert not sheet.section("Specification Links").is_empty
    assert read("# A\n<!-- b -->\n## C\n").section("A").is_empty


def test_an_empty_sheet_claims_nothing():
    sheet = read("")
    assert (sheet.title, sheet.sections, sheet.sensors) == ("", (), ())
    assert (sheet.total_mass, sheet.endurance, sheet.limits) == (None, None, ())


def test_a_section_of_fenced_code_says_something():
    sheet = read("# R\n## Usage\n```\nroslaunch\n```\n## Rights\n## Links\nhttps://example.org\n")
    said = {each.title: not sheet.says_nothing(each) for each in sheet.sections}
    assert said == {"R": True, "Usage": True, "Rights": False, "Links": True}


def test_a_section_reaches_to_the_next_of_its_level_or_above():
    sheet = read("# A\n## B\nb\n### C\nc\n## D\n# E\n")
    stretches = {each.title: sheet.stretch_of(each).text for each in sheet.sections}
    assert stretches["B"].split() == ["B", "b", "###", "C", "c", "##"]
    assert stretches["C"].split() == ["C", "c", "##"]
    assert stretches["E"].strip() == "E"


def test_a_sheet_that_is_not_read_to_its_end_says_so():
    assert not read("# A\n").unread
    assert "200,000" in read("# A\n" + "word " * 50_000).unread


def test_a_sheet_may_leave_sensors_to_another():
    text = "# R\n### Sensors\nSee [the base](../base/specifications.md#sensors).\n"
    assert read(text).other_sensors == "../base/specifications.md"
    assert read(TEXT).other_sensors == ""
    assert read("# R\n").other_sensors == ""
