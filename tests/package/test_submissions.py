"""Whose package a sentence is about."""

from __future__ import annotations

import pytest

from checker.package.submissions import (
    blank_xml_comments,
    described_package,
    is_same_robot,
    is_slip_for,
    left_from_copying,
    stated_number,
    title_of_another,
)

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


@pytest.mark.parametrize(
    ("written", "meant", "slip"),
    [
        ("acme_rover_gazebo_plugin", "acme_rover_gazebo_plugin_1", True),
        ("acme_rover_gazebo_plugins_1", "acme_rover_gazebo_plugin_1", True),
        ("acme_crawlr_sensor_config_1", "acme_crawler_sensor_config_1", True),
        ("acme_crawler_sensorconfig_1", "acme_crawler_sensor_config_1", True),
        ("acme_lab_rover_sensor_config_1", "acme_labs_rover_sensor_config_1", False),
        ("acme_rover_b_sensor_config_1", "acme_rover_c_sensor_config_1", False),
        ("acme_rover_sensor_config_1", "acme_rover_sensor_config_2", False),
        ("x1_sensor_config_6", "acme_x1_sensor_config_6", False),
        ("acme_rover_sensor_config_1", "acme_husky_sensor_config_1", False),
    ],
)
def test_a_slip_is_one_word_misspelt_or_left_out(written: str, meant: str, slip: bool) -> None:
    assert is_slip_for(written, meant) is slip
    assert is_slip_for(meant, written) is slip


@pytest.mark.parametrize(
    ("text", "package"),
    [
        ("The acme_rover_sensor_config_2 package", "acme_rover_sensor_config_2"),
        ("The acme_rover_sensor_config_2 tracked robot package", "acme_rover_sensor_config_2"),
        ("The acme_rover_sensor_config_2 is a rover", "acme_rover_sensor_config_2"),
        ("The acme_rover_sensor_config_2 with breadcrumbs", ""),
        ("The husky_description package", "husky_description"),
        ("Arms. The husky_description package", "husky_description"),
        ("It has the same topics as the husky_description package", ""),
        ("The ACME_rover_sensor_config_1 package", ""),
        ("The acme_rover_sensor_config_2 based robot package", ""),
        ("The husky_description helper package", ""),
        ("A package", ""),
    ],
)
def test_the_package_that_a_template_describes(text: str, package: str) -> None:
    assert described_package(text, OWN) == package


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("Acme X2 Config 3", 3),
        ("Acme Rover Sensor Configuration #12", 12),
        ("Acme Rover Config2", 2),
        ("Acme Rover 2", None),
        ("Acme Rover Config 1 and 2", None),
        ("Config 1, config 2", None),
    ],
)
def test_the_configuration_that_plain_words_name(name: str, number: int | None) -> None:
    assert stated_number(name) == number


@pytest.mark.parametrize(
    ("sheet", "other"),
    [
        ("# X1 Sensor Config 6", True),
        ("# The rover, sensor config 6", False),
        ("# X1", False),
    ],
)
def test_a_title_that_shares_no_word_with_the_robot(sheet: str, other: bool) -> None:
    assert (title_of_another(sheet, OWN) is not None) is other
