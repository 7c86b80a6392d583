"""Which links of a sheet show what the real robot can do."""

from __future__ import annotations

import pytest

from checker.model.specification.proof import Proven
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


VIDEO = "https://youtu.be/H15Kpvpepv4"


def sheet(endurance: str = "", validation: str = "", sensors: str = "") -> str:
    return (
        f"# Rover\n\n## Sensors\n{sensors}\n\n## Endurance Characteristics\n{endurance}\n\n"
        f"## Validation and Specification Links\n{validation}\n"
    )


@pytest.mark.parametrize(
    "text",
    [
        sheet(f"Two hours, see {VIDEO}"),
        sheet("Two hours until the batteries were empty.", f"* {VIDEO}"),
        sheet("Two hours.", f"* Endurance test: our camera stopped after a while: {VIDEO}"),
        sheet("Two hours.", f"* {VIDEO}\n* Maximum linear speed: TBD\n* Mass measurement: TBD"),
        sheet("Two hours.", f"* Endurance video: {VIDEO}\n* Endurance data: TBD"),
        sheet("Two hours. The turning radius was not measured.", f"* {VIDEO}"),
        sheet("Two hours.", "See [there](../other_sensor_config_1/specifications.md)."),
    ],
)
def test_proof_of_endurance(text: str) -> None:
    assert read_specification(SourceText("s.md", text)).proves(Proven.ENDURANCE)


@pytest.mark.parametrize(
    "text",
    [
        sheet("Two hours."),
        sheet("Two hours.", sensors=f"* Ouster OS1: {VIDEO}"),
        sheet("Two hours by the tests of https://acme.com/guide"),
        sheet(f"The camera runs longer: {VIDEO}"),
        sheet("Two hours.", f"* Lidar in dust, video: {VIDEO}"),
        sheet("Two hours.", "* https://acme.com/products/imu-7"),
        sheet("One hour until validation is completed.", f"* {VIDEO}"),
        sheet("The tests are not completed.", f"* {VIDEO}"),
        sheet("The endurance has not been validated yet.", f"* {VIDEO}"),
        sheet("A full drain test was not able to be performed.", f"* {VIDEO}"),
        sheet("We were unable to perform validation tests.", f"* Speed test: {VIDEO}"),
        sheet("Two hours.", f"* Speed test: {VIDEO}\n* Endurance test: to be done"),
        sheet("Two hours.", f"* Endurance test, to be done: {VIDEO}"),
    ],
)
def test_no_proof_of_endurance(text: str) -> None:
    assert not read_specification(SourceText("s.md", text)).proves(Proven.ENDURANCE)


def test_the_angular_speed_is_another_test() -> None:
    text = f"# Rover\n## Validation\n* {VIDEO}\n* Maximum angular speed: TBD\n"
    assert read_specification(SourceText("s.md", text)).proves(Proven.SPEED)
    text = f"# Rover\n## Validation\n* {VIDEO}\n* Maximum linear speed: TBD\n"
    assert not read_specification(SourceText("s.md", text)).proves(Proven.SPEED)


def test_the_section_ends_with_the_next_heading_of_its_level() -> None:
    below = in_section("### Data\n\n* Speed test: https://acme.com/1")
    behind = in_section("## Thanks\n\n* Speed test: https://acme.com/1")
    assert links(below) == ["https://acme.com/1"]
    assert links(behind) == []
