"""Which team's robot a text speaks of."""

from __future__ import annotations

import pytest

from checker.package.teams import other_teams

OWN = "acme_rover_sensor_config_1"


@pytest.mark.parametrize(
    ("text", "team"),
    [
        ("Coordinated Robotics - Rover", "Coordinated Robotics"),
        ("The CTU-CRAS-Norlab rover", "CTU-CRAS-Norlab"),
        ("CTU_CRAS NORLAB rover", "CTU_CRAS NORLAB"),
        ("CSIRO-Data61's tracked rover", "CSIRO"),
        ("Validation for the MARBLE\nHusky", "MARBLE"),
        ("Marble Husky with Sensor Configuration 1", "Marble"),
        ("Team Explorer's rover", "Explorer"),
        ("Explorer - DS1", "Explorer"),
        ("CMU Explorer ds1", "CMU Explorer"),
        ("A rover with four wheels and two arms of Emesent", "Emesent"),
    ],
)
def test_another_team_is_named(text: str, team: str) -> None:
    assert [match.group() for match in other_teams(text, OWN)] == [team]


@pytest.mark.parametrize(
    "text",
    [
        "An explorer of caves, smooth as marble, with a dynamo",
        "Marble slabs - a hazard",
        "The Explorer has six wheels",
        "Based on the arm that the MARBLE Husky carries",
        "A rover with the Emesent Hovermap",
        "The same as CTU-CRAS-Norlab's",
        "See https://example.org/cerberus/robots and mail@cerberus.org",
        "The command starts cerberus_anymal_b_sensor_config_1",
        "Robotikax",
    ],
)
def test_a_word_or_an_origin_is_no_other_team(text: str) -> None:
    assert not list(other_teams(text, OWN))


@pytest.mark.parametrize(
    ("text", "package"),
    [
        ("BARCS MARBLE QAV500", "barcs_qav500_sensor_config_1"),
        ("Marble's HD2, built by SSCI", "marble_hd2_sensor_config_1"),
        ("The Emesent Hovermap", "csiro_data61_dtr_sensor_config_1"),
        ("CTU-CRAS-NORLAB X500", "CTU_CRAS_NORLAB_X500_SENSOR_CONFIG_1"),
    ],
)
def test_the_own_team_and_its_partners_are_right(text: str, package: str) -> None:
    assert not list(other_teams(text, package))


def test_each_sentence_counts_alone() -> None:
    text = "The BARCS QAV500. It belongs to MARBLE."
    named = list(other_teams(text, "barcs_qav500_sensor_config_1"))
    assert [match.span() for match in named] == [(text.index("MARBLE"), len(text) - 1)]
