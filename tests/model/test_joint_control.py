"""Rovers of autopilots: one plugin a wheel, and nothing that says how they belong together."""

from __future__ import annotations

import pytest

from checker.model.locomotion.locomotion import DriveKind, Side
from checker.model.robot import Robot
from checker.physics.trial.drivers.plans import plan_of
from tests.model.robots import sdf
from tests.model.test_locomotion import BASE, plugin, tags, wheel

LEFT, RIGHT = wheel("left_wheel", "-0.2 0.2 0"), wheel("right_wheel", "-0.2 -0.2 0")
FRONT = wheel("front_left_wheel", "0.2 0.2 0") + wheel("front_right_wheel", "0.2 -0.2 0")


def turned(*names: str) -> str:
    return "".join(plugin("JointController", tags(joint_name=f"{name}_axle")) for name in names)


BOTH = turned("right_wheel", "left_wheel")


def steered(side: str, y: float, axis: str = "0 0 1", x: float = 0.2) -> str:
    """A wheel on a knuckle."""
    name = f"{side}_knuckle"
    return (
        f'<link name="{name}"><pose>{x} {y} 0 0 0 0</pose></link>'
        f'<joint name="{name}_joint" type="revolute"><parent>base</parent><child>{name}</child>'
        f"<axis><xyz>{axis}</xyz><limit><lower>-0.5</lower><upper>0.5</upper></limit></axis></joint>"
        + wheel(f"front_{side}_wheel", f"{x} {y} 0", parent=name)
        + plugin("JointPositionController", tags(joint_name=f"{name}_joint"))
    )


def test_two_wheels_side_by_side_are_a_differential_drive() -> None:
    moves = sdf(BASE + LEFT + RIGHT + BOTH).locomotion
    assert moves.kind is DriveKind.DIFFERENTIAL
    assert moves.by_joint is not None
    sides = {wheel.name.value: wheel.side for wheel in moves.by_joint.wheels}
    assert sides == {"left_wheel_axle": Side.LEFT, "right_wheel_axle": Side.RIGHT}
    assert moves.by_joint.wheel_separation.value == pytest.approx(0.4)
    assert moves.by_joint.wheel_radius.value == pytest.approx(0.1)


def test_no_plugin_holds_figures_that_a_rule_could_judge() -> None:
    moves = sdf(BASE + LEFT + RIGHT + BOTH).locomotion
    assert (moves.wheel_drives, moves.wheels) == ((), ())
    assert {wheel.name.value for wheel in moves.undriven} == {"left_wheel_axle", "right_wheel_axle"}


def test_two_pairs_skid() -> None:
    four = turned("left_wheel", "right_wheel", "front_left_wheel", "front_right_wheel")
    assert sdf(BASE + LEFT + RIGHT + FRONT + four).locomotion.kind is DriveKind.SKID_STEER


def test_an_autopilot_that_turns_joints_itself() -> None:
    channels = "".join(
        f'<control channel="{number}"><type>VELOCITY</type><jointName>{side}_wheel_axle</jointName>'
        "</control>"
        for number, side in enumerate(("left", "right"))
    )
    autopilot = f'<plugin name="ArduPilotPlugin" filename="ArduPilotPlugin">{channels}</plugin>'
    assert sdf(BASE + LEFT + RIGHT + autopilot).locomotion.kind is DriveKind.DIFFERENTIAL


def test_wheels_on_knuckles_steer() -> None:
    robot = sdf(BASE + LEFT + RIGHT + steered("left", 0.2) + steered("right", -0.2) + BOTH)
    assert robot.locomotion.kind is DriveKind.ACKERMANN
    plan = plan_of(robot)
    assert not plan.turns_in_place
    left, right = (plan.places[f"{side}_knuckle_joint"] for side in ("left", "right"))
    assert left == right, "one command steers both"
    assert max(angle for _, angle in left) == pytest.approx(0.3, abs=0.01)


UNCLEAR = {
    "one of them turns the other way": LEFT + wheel("right_wheel", "-0.2 -0.2 0", axis="0 -1 0"),
    "the robot faces sideways": wheel("left_wheel", "0.2 0 0", axis="1 0 0")
    + wheel("right_wheel", "-0.2 0 0", axis="1 0 0"),
    "no pair": LEFT + wheel("right_wheel", "0.3 -0.2 0"),
    "both on one side": LEFT + wheel("right_wheel", "0.2 0.2 0"),
}


@pytest.mark.parametrize("wheels", UNCLEAR.values(), ids=UNCLEAR)
def test_what_is_not_certain_is_not_driven(wheels: str) -> None:
    robot = sdf(BASE + wheels + BOTH)
    assert robot.locomotion.kind is DriveKind.NONE
    assert not robot.locomotion.drives
    assert plan_of(robot).not_driven == robot.locomotion.doubt != ""


def test_steering_in_front_and_behind_is_not_driven() -> None:
    knuckles = steered("left", 0.2) + steered("right", -0.2, x=-0.2)
    robot = sdf(BASE + LEFT + RIGHT + knuckles + BOTH)
    assert "steer" in plan_of(robot).not_driven


NO_WHEELS = {
    "a mower's blade": wheel("blade", "0 0 0", axis="0 0 1") + turned("blade"),
    "an arm": wheel("arm", "0 0 0.5", axis="0 1 0") + turned("arm"),
    "no such joint": turned("nobody"),
}


@pytest.mark.parametrize("content", NO_WHEELS.values(), ids=NO_WHEELS)
def test_other_joints_are_no_wheels(content: str) -> None:
    moves = sdf(BASE + content).locomotion
    assert (moves.kind, moves.by_joint, moves.doubt) == (DriveKind.NONE, None, "")


def test_a_plugin_that_drives_all_wheels_counts_alone() -> None:
    named = plugin("DiffDrive", tags(left_joint="left_wheel_axle", right_joint="right_wheel_axle"))
    moves = sdf(BASE + LEFT + RIGHT + BOTH + named).locomotion
    assert moves.by_joint is None
    assert len(moves.drives) == 1


def why_not(content: str) -> str:
    robot: Robot = sdf(BASE + content)
    return plan_of(robot).not_driven


@pytest.mark.parametrize(
    ("content", "word"),
    [
        (plugin("LiftDrag", ""), "flies"),
        (plugin("MulticopterMotorModel", tags(jointName="w_axle", linkName="w")), ""),
        (plugin("Hydrodynamics", ""), "swims"),
        (plugin("Thruster", ""), "swims"),
        (
            plugin("MecanumDrive", tags(front_left_joint="w_axle")) + wheel("w"),
            "wheels with rollers",
        ),
        ("", ""),
    ],
)
def test_what_the_trial_cannot_move_says_why(content: str, word: str) -> None:
    reason = why_not(content)
    assert word in reason
    assert bool(reason) is bool(word)
