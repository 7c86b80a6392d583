"""Robots of ROS 2 and of autopilots drive as their controllers and plugins tell them to."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from checker.engine.subject import Subject
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.physics.trial.trial import Trial
from support.real_packages import MODERN, needed_folder, needs
from tests.trial.machines import trial_in_child, value

pytestmark = needs(MODERN)

GZ = "gz_ros2_control/gz_ros2_control_demos"
PX4 = "PX4-gazebo-models/models"
CREATE3 = "create3_sim/irobot_create_common/irobot_create_description"
CONTROLLED = [
    (GZ, "diff_drive", "differential drive"),
    (GZ, "tricycle_drive", "Ackermann steering"),
    (CREATE3, "create3", "differential drive"),
]
"""Robots that turn as they are told: package, name, drive."""
ROVERS = [
    (f"{PX4}/rover_differential", "rover_differential", "differential drive"),
    (f"{PX4}/rover_ackermann", "rover_ackermann", "Ackermann steering"),
    (f"{PX4}/lawnmower", "zero_turn_mower", "differential drive"),
]


@cache
def robots_of(package: str) -> dict[str, Robot]:
    """Return the robots of a package by their names, without their meshes."""
    with open_input(needed_folder(MODERN) / Path(package)) as opened:
        subject = Subject(opened.packages[0])
        robots = subject.all(Robot)
        assert isinstance(robots, tuple), robots
        found = {robot.name.value: robot for robot in robots}
        # Meshes are read while the folder is there.
        for robot in robots:
            _ = [robot.box_of(link) for link in robot.links]
        subject.close()
    return found


@cache
def driven(package: str, name: str) -> Trial:
    trial = trial_in_child(robots_of(package)[name])
    assert isinstance(trial, Trial), trial
    return trial


@pytest.mark.parametrize(("package", "name", "drive"), [*CONTROLLED, *ROVERS])
def test_it_drives_straight_at_the_commanded_speed(package: str, name: str, drive: str) -> None:
    trial = driven(package, name)
    assert trial.drive == drive
    assert not trial.refused
    assert 0.97 < value(trial, "speed_ratio") < 1.03
    assert abs(value(trial, "path_sideways")) < 0.02
    assert value(trial, "stop_speed") < 0.01


@pytest.mark.parametrize(("package", "name"), [each[:2] for each in (*CONTROLLED, *ROVERS)])
def test_it_turns_as_commanded(package: str, name: str) -> None:
    # PX4 turns both rear wheels of its car alike: they scrub, and the circle gets wider.
    least = 0.5 if name == "rover_ackermann" else 0.93
    assert least < value(driven(package, name), "yaw_ratio") < 1.05


def test_steering_joints_whose_axes_point_down_turn_it_the_other_way() -> None:
    trial = driven(GZ, "ackermann_drive")
    assert 0.97 < value(trial, "speed_ratio") < 1.03
    assert -1.05 < value(trial, "yaw_ratio") < -0.7


def test_wheels_that_are_listed_on_the_other_side_turn_it_the_other_way() -> None:
    trial = driven("ros2_control_demos/example_2", "diffdrive_robot")
    assert trial.drive == "differential drive"
    # Its wheels of 15 mm turn at 1 rad/s at most, and its casters are fixed spheres, which drag.
    assert 0.0 < value(trial, "speed_ratio") < 0.05
    assert value(trial, "yaw_ratio") < 0.0


def test_front_wheels_that_cannot_roll_hold_it_back() -> None:
    trial = driven("ros2_control_demos/example_11", "carlikebot_robot")
    assert trial.drive == "Ackermann steering"
    assert abs(value(trial, "speed_ratio")) < 0.1
