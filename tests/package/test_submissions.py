"""Whose package a sentence is about."""

from __future__ import annotations

import pytest

from checker.package.submissions import blank_xml_comments, is_same_robot, left_from_copying

OWN = "acme_rover_sensor_config_1"


@pytest.mark.parametrize(
    "text",
    ["The x1_sensor_config_6 package", "X1_SENSOR_CONFIG_6 has a lidar", "x1_sensor_config_6"],
)
def test_another_name_is_left_from_copying(text: str) -> None:
    assert [match.group().lower() for match in left_from_copying(text, OWN)] == [
        "x1_sensor_config_6"
    ]


@pytest.mark.parametrize(
    "text",
    [
        "The acme_rover_sensor_config_1 package",
        "acme_rover_sensor_config_2 adds breadcrumbs",
        "ROVER_SENSOR_CONFIG_1",
        "derived from x1_sensor_config_4",
        "based on the robot x1_sensor_config_4",
        "the same lidar as x1_sensor_config_4",
        "https://example.org/x1_sensor_config_4",
    ],
)
def test_a_name_that_is_meant_is_not(text: str) -> None:
    assert not list(left_from_copying(text, OWN))


@pytest.mark.parametrize(
    ("name", "other", "same"),
    [
        (OWN, "acme_rover_sensor_config_2", True),
        ("x2_sensor_config_5", "acme_x2_sensor_config_1", True),
        ("x2_sensor_config_5", "acme_ux2_sensor_config_1", False),
        (OWN, "acme_sensor_config_1", False),
    ],
)
def test_configurations_of_one_robot(name: str, other: str, same: bool) -> None:
    assert is_same_robot(name, other) is same
    assert is_same_robot(other, name) is same


@pytest.mark.parametrize(
    ("text", "blanked"),
    [
        ("a<!-- b\nc -->d", "a      \n     d"),
        ("a<!-- b", "a<!-- b"),
        ("-->a<!---->", "-->a       "),
    ],
)
def test_comments_become_blanks(text: str, blanked: str) -> None:
    assert blank_xml_comments(text) == blanked
    assert len(blanked) == len(text)
