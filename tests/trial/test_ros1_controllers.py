"""Controllers of ROS 1 drive a robot whose joints have transmissions."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.model.locomotion.locomotion import DriveKind
from checker.model.robot import Robot
from checker.physics.trial.drivers.plans import plan_of
from checker.physics.trial.trial import Trial
from checker.rule_testing import write_example
from tests.model.controlled import robot_in
from tests.model.robots import urdf
from tests.trial.machines import trial_in_child, value
from tests.trial.test_controllers import BALL, CORNERS, FOUR, REAR, TRUNK

TRANSMISSION = """<transmission name="{0}_motor">
  <type>transmission_interface/SimpleTransmission</type>
  <joint name="{0}"><hardwareInterface>{1}JointInterface</hardwareInterface></joint>
  <actuator name="{0}_actuator"/></transmission>"""
LOAD = """<launch>
  <rosparam file="$(find acme_arm_description)/config/base.yaml" command="load" ns="/acme"/>
</launch>"""
DIFF = """base:
  type: diff_drive_controller/DiffDriveController
  left_wheel: rear_left
  right_wheel: [rear_right]
  linear: {x: {has_velocity_limits: true, max_velocity: 0.6}}
"""
TWO = ("rear_left", "rear_right")


def robot(folder: Path, links: str, joints: tuple[str, ...], parameters: str, launch: str) -> Robot:
    motors = "".join(TRANSMISSION.format(name, "Velocity") for name in joints)
    files = {"config/base.yaml": parameters, "launch/control.launch": launch}
    return robot_in(write_example({"@urdf": TRUNK + links + motors, **files}, folder))


def driven(one: Robot) -> Trial:
    trial = trial_in_child(one)
    assert isinstance(trial, Trial), trial
    assert not trial.not_driven
    return trial


@pytest.mark.parametrize("launch", [LOAD, "<launch/>"])
def test_a_differential_drive_measures_what_is_not_stated(tmp_path: Path, launch: str) -> None:
    trial = driven(robot(tmp_path, REAR + BALL, TWO, DIFF, launch))

    assert trial.drive == DriveKind.DIFFERENTIAL
    assert value(trial, "full_speed_limit") == 0.6
    assert value(trial, "speed_ratio") == pytest.approx(1.0, abs=0.02)
    assert value(trial, "yaw_ratio") == pytest.approx(1.0, abs=0.05)


def test_a_stated_radius_counts(tmp_path: Path) -> None:
    trial = driven(robot(tmp_path, REAR + BALL, TWO, DIFF + "  wheel_radius: 0.2\n", LOAD))

    assert value(trial, "speed_ratio") == pytest.approx(0.5, abs=0.02)


@pytest.mark.parametrize("family", ["velocity_controllers", "effort_controllers"])
def test_velocity_controllers_of_single_wheels(tmp_path: Path, family: str) -> None:
    kind = f"type: {family}/JointVelocityController"
    parameters = "".join(f"{name}_motor: {{{kind}, joint: {name}}}\n" for name in CORNERS)
    trial = driven(robot(tmp_path, FOUR, tuple(CORNERS), parameters, LOAD))

    assert trial.drive == DriveKind.SKID_STEER
    assert value(trial, "speed_ratio") == pytest.approx(1.0, abs=0.02)


def test_velocity_controllers_of_several_wheels(tmp_path: Path) -> None:
    kind = "velocity_controllers/JointGroupVelocityController"
    parameters = f"wheels: {{type: {kind}, joints: [{', '.join(CORNERS)}]}}\n"
    assert driven(robot(tmp_path, FOUR, tuple(CORNERS), parameters, LOAD)).measurements


def test_position_controllers_are_named_and_hold(tmp_path: Path) -> None:
    kind = "type: effort_controllers/JointPositionController"
    parameters = f"left: {{{kind}, joint: rear_left}}\nright: {{{kind}, joint: rear_right}}\n"
    plan = plan_of(robot(tmp_path, REAR + BALL, TWO, parameters, LOAD))
    assert not plan.speeds
    assert "JointPositionController" in plan.not_driven


def test_transmissions_alone_move_nothing() -> None:
    motors = "".join(TRANSMISSION.format(name, "Velocity") for name in TWO)
    plan = plan_of(urdf('<link name="base_link"/>' + REAR + motors))
    assert not plan.speeds
    assert "2 transmissions for controllers of ROS 1, and the package loads none" in plan.not_driven


@pytest.mark.parametrize(("namespace", "is_loaded"), [("acme", True), ("rover", False)])
def test_a_controller_spawned_in_another_namespace_moves_nothing(
    tmp_path: Path, namespace: str, is_loaded: bool
) -> None:
    spawner = f"""<node ns="{namespace}" name="spawner" pkg="controller_manager" type="spawner"
        args="base"/></launch>"""
    launch = LOAD.replace("</launch>", spawner)
    plan = plan_of(robot(tmp_path, REAR + BALL, TWO, DIFF, launch))
    assert bool(plan.speeds) is is_loaded


def test_controllers_of_another_robot_move_nothing(tmp_path: Path) -> None:
    other = DIFF.replace("rear_", "other_")
    assert not plan_of(robot(tmp_path, REAR + BALL, TWO, other, LOAD)).speeds
