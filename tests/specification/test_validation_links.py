"""Which links of a sheet show what the real robot can do."""

from __future__ import annotations

import pytest

from checker.model.specification.sheet import read_specification
from checker.source.text import SourceText


def links(text: str) -> list[str]:
    sheet = read_specification(SourceText("specifications.md", text))
    return [link.text for link in sheet.validation_links]


def in_section(line: str) -> str:
    return f"# Rover\n\n## Motion\n\n## Validation and Specification Links\n\n{line}\n"


@pytest.mark.parametrize(
    "line",
    [
        "* https://youtu.be/H15Kpvpepv4",
        "* [Validation data](https://acme.com/flights.bag)",
        "* Speed test: https://acme.com/1",
        "* https://drive.google.com/drive/folders/1y (datalogs)",
        "* https://acme.com/rover/1",
        "Measured by us:\n\n1. <https://acme.com/rover/1>",
    ],
)
def test_videos_and_data_prove_something(line: str) -> None:
    assert len(links(in_section(line))) == 1


@pytest.mark.parametrize(
    "line",
    [
        "* [Velodyne VLP-16](https://velodynelidar.com/products/puck)",
        "* Camera: https://acme.com/high-speed-test-camera",
        "* Sensors:\n  * https://velodynelidar.com/products/puck",
        "* [Validation video](https://youtu.be/xxxxxxxxx/)",
        "* [Validation data]()",
        "<!-- * https://youtu.be/H15Kpvpepv4 -->",
        "<!-- * https://youtu.be/H15Kpvpepv4",
    ],
)
def test_datasheets_placeholders_and_comments_prove_nothing(line: str) -> None:
    assert links(in_section(line)) == []


def test_elsewhere_only_the_host_says_what_a_link_is() -> None:
    text = "# Rover\n\n## Motion\n\nBy the tests of https://acme.com/guide: https://youtu.be/H15K\n"
    assert links(text) == ["https://youtu.be/H15K"]


def test_the_section_ends_with_the_next_heading_of_its_level() -> None:
    below = in_section("### Data\n\n* Speed test: https://acme.com/1")
    behind = in_section("## Thanks\n\n* Speed test: https://acme.com/1")
    assert links(below) == ["https://acme.com/1"]
    assert links(behind) == []
