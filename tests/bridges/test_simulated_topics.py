"""Topics that plugins have in Gazebo."""

from __future__ import annotations

import pytest

from checker.ros.simulated_topics import simulated_topics, unknown_owner
from tests.model.robots import sdf


@pytest.mark.parametrize(
    ("control", "topic"),
    [
        ("<jointName>left</jointName>", "/model/*/joint/left/cmd"),
        ("<jointName>left</jointName><cmd_topic>/left</cmd_topic>", "/left"),
    ],
)
def test_the_topics_of_ardupilot_are_known(control: str, topic: str) -> None:
    robot = sdf(
        f"""<plugin name="ArduPilotPlugin" filename="ArduPilotPlugin">
        <control channel="0">{control}</control></plugin>"""
    )
    assert [each.topic for each in simulated_topics(robot)] == [topic]
    assert not unknown_owner(robot)
