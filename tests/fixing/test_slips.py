"""A fix writes a name only for a slip of the pen that can mean no other name."""

from __future__ import annotations

import pytest

from checker.base.words import Suggestions

JOINTS = ("front_left_wheel", "front_right_wheel", "rear_left_wheel", "arm_1", "arm_2")


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("front_lef_wheel", "front_left_wheel"),
        ("front_letf_wheel", "front_left_wheel"),
        ("Rear_left_Wheel", "rear_left_wheel"),
        # As near as another, another part of the same kind, or too far off.
        ("arm_3", None),
        ("arm_", None),
        ("rear_right_wheel", None),
        ("front_wheel", None),
        ("gripper", None),
    ],
)
def test_slips(written: str, meant: str | None) -> None:
    assert Suggestions(JOINTS).correction(written) == meant


def test_the_only_wheel_that_there_is_may_still_be_another_one() -> None:
    assert Suggestions(["front_left_wheel_joint"]).closest("front_right_wheel_joint") is not None
    assert Suggestions(["front_left_wheel_joint"]).correction("front_right_wheel_joint") is None


def test_of_two_that_are_as_near_none_is_written() -> None:
    assert Suggestions(["wheel_a", "wheel_b"]).correction("wheel_") is None


def test_hint_names_the_one_longer_name() -> None:
    """The end of a name is often left out; where several names continue it, none is meant."""
    joints = Suggestions(["claw_joint", "arm_joint", "arm_link_joint"])
    assert joints.hint("claw") == "; did you mean 'claw_joint'?"
    assert joints.hint("arm") == ""
    assert joints.correction("claw") is None
