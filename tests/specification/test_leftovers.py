"""Placeholders, struck-through text and links of a sheet."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.specification.links import relative_links, without_datasheet
from checker.model.specification.sheet import read_specification
from checker.model.specification.sheet_text import (
    links_without_target,
    placeholders,
    struck_through,
)
from checker.source.markdown import Markdown, read_markdown
from checker.source.text import SourceText
from tests.effort import limited


def read(text: str) -> Markdown:
    return read_markdown(SourceText("specifications.md", text))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Endurance: TBD.", "TBD"),
        ("TODO: the mass", "TODO"),
        ("[Guide](https://a.example/\\<fix_me\\>)", "\\<fix_me\\>"),
        ("https://youtu.be/xxxxxxxxx/", "https://youtu.be/xxxxxxxxx"),
        ("# Diversions of \\<Robot Name\\>", "\\<Robot Name\\>"),
        ("<Explanation of Diversions\\>", "<Explanation of Diversions\\>"),
        ("\\<Video Link(s), e.g., https://a.example\\>", None),
    ],
)
def test_a_placeholder_is_found(text: str, words: str | None):
    (found,) = placeholders(read(text))
    assert found.words == (words or text)
    assert found.span.text == found.words


@pytest.mark.parametrize(
    "text",
    [
        "<!-- TODO -->",
        "```\nTODO\n```",
        "/<Robot Name>/cmd_vel",
        "<maximumLinearVelocity>4 4 5</maximumLinearVelocity>",
        "https://youtu.be/xxAb12xx_xx",
        "mastodon todo list, tbdx",
        "\\<Motion Test Link, https://youtu.be/K0IjFDt\\>",
    ],
)
def test_these_are_no_placeholders(text: str):
    assert not list(placeholders(read(text)))


def test_struck_through_text_is_found_the_innermost_where_marks_are_nested():
    text = "a ~~b~~ c <s>d</s> e <del>f ~~g~~</del> ~~~ h"
    assert [each.words for each in struck_through(read(text))] == ["b", "d", "g"]


def test_a_link_without_target_is_found():
    (found,) = links_without_target(read("[a](b) [Navi Drone]()"))
    assert found.words == "Navi Drone"


def test_relative_links_are_those_to_files():
    text = "[a](LICENSE) [b](docs/a%20b.md#c) [d](#e) [f](https://g.example) [h](/i) ![j](k.png)"
    links = list(relative_links(read(text)))
    assert [each.value for each in links] == ["LICENSE", "docs/a b.md", "k.png"]
    assert links[1].span.text == "docs/a%20b.md#c"


def test_a_device_is_linked_where_a_line_with_a_link_names_it():
    sheet = read_specification(
        SourceText(
            "specifications.md",
            "# R\n## Sensors\n* LIDAR - Velodyne-16\n* IMU: Xsens MTi-30\n* RGBD camera D435i\n"
            "* IMU\n## Links\n* https://velodynelidar.com\n* https://a.example/depth-camera-d435/\n",
        )
    )
    found = without_datasheet(sheet.markdown, sheet.sensors)
    assert [each.text for each in found] == ["IMU: Xsens MTi-30"]


@given(st.text(alphabet="[]()<>~\\/ aAsxTBD:.#\n`!", max_size=300))
def test_any_text_is_read_and_places_lie_in_it(text: str):
    markdown = read(text)
    for found in (
        *placeholders(markdown),
        *links_without_target(markdown),
        *struck_through(markdown),
        *relative_links(markdown),
    ):
        assert 0 <= found.span.start <= found.span.end <= len(text)


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        "TODO ~~a~~ [b](c) " * 600_000,
        "https://" + "/xxx" * 50_000 + "y",
        "x" * 1_000_000,
        "[" * 100_000 + "](" * 50_000,
        "<A " * 60_000,
        "* 1 x D435, modeled by rgbd_camera\n" * 100_000,
    ],
    ids=["ten megabytes", "a long link", "one word", "brackets", "tags", "items"],
)
def test_a_sheet_of_any_size_is_read_within_seconds(text: str):
    with limited(20):
        sheet = read_specification(SourceText("specifications.md", f"# R\n## Sensors\n{text}"))
        list(placeholders(sheet.markdown))
        list(struck_through(sheet.markdown))
        list(relative_links(sheet.markdown))
        without_datasheet(sheet.markdown, sheet.sensors)
