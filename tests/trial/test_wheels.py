"""Robots on wheels: what drives well drives straight, and each cause shows in its figure."""

from __future__ import annotations

import math
from collections.abc import Iterator

import msgspec
import pytest

from checker.formats.sdf.reader import read_sdf
from checker.model.robot import Robot
from checker.physics.trial.trial import Trial
from checker.rulebook.example_parts import rover
from tests.model.robots import document, sdf
from tests.trial.machines import (
    LEFT,
    RIGHT,
    chassis,
    diff_drive,
    four_wheels,
    sound,
    trial_in_child,
    trial_of,
    value,
    wheel,
)

SAME = 1e-6
"""Relative, or in SI units, by which figures of two processes may differ: their linear algebra may
run on another number of threads."""


def test_a_sound_robot_drives_as_told() -> None:
    trial = sound(four_wheels())
    assert 0.97 < value(trial, "speed_ratio") < 1.03
    assert abs(value(trial, "path_sideways")) < 1e-3
    assert abs(value(trial, "path_heading")) < 1e-3
    assert value(trial, "stop_speed") < 1e-3
    assert value(trial, "settle_speed") < 1e-3
    assert 0.009 < value(trial, "settle_drop") < 0.02
    assert value(trial, "rest_penetration") < 3e-4
    assert value(trial, "energy_gain") < 0.1
    assert value(trial, "turn_drift") < 0.02


def test_damping_of_its_joint_does_not_slow_a_wheel() -> None:
    """Its motor gives the torque, 2 N·m·s/rad times the speed; so does Gazebo's."""
    trial = sound(four_wheels(damping=2.0))
    assert value(trial, "speed_ratio") == pytest.approx(1.0, abs=0.01)


def test_full_speed_keeps_the_limits_of_the_plugin() -> None:
    trial = sound(four_wheels())
    assert abs(value(trial, "full_speed") - value(trial, "full_speed_limit")) < 0.01
    assert value(trial, "full_acceleration") < 1.05 * value(trial, "full_acceleration_limit")


@pytest.mark.slow
def test_the_turn_is_what_the_contact_loads_predict() -> None:
    for base in (0.2, 0.4, 0.6):
        trial = sound(four_wheels(base=base))
        assert 0.8 < value(trial, "yaw_of_predicted") < 1.2
        assert value(trial, "yaw_ratio") < 0.9


def test_two_runs_are_the_same_to_the_bit() -> None:
    robot = four_wheels(com="0.02 0.01 0")
    assert trial_of(robot) == trial_of(robot)


def test_the_child_measures_what_this_process_measures() -> None:
    robot = four_wheels()
    trial = trial_in_child(robot)
    assert isinstance(trial, Trial)
    here = dict(leaves(msgspec.to_builtins(Trial.from_json(trial_of(robot).as_json()))))
    there = dict(leaves(msgspec.to_builtins(trial)))
    assert there.keys() == here.keys()
    assert not {at: (there[at], here[at]) for at in here if not same(there[at], here[at])}


def leaves(value: object, path: str = "") -> Iterator[tuple[str, object]]:
    """Yield the numbers and words in lists and mappings, each with its place there."""
    if isinstance(value, dict | list | tuple):
        pairs = value.items() if isinstance(value, dict) else enumerate(value)
        for key, inner in pairs:
            yield from leaves(inner, f"{path}/{key}")
    else:
        yield path, value


def same(one: object, other: object) -> bool:
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=SAME, abs_tol=SAME)
    return one == other


def test_a_reversed_axis_drives_backwards() -> None:
    trial = sound(four_wheels(axis="0 -1 0"))
    assert -1.03 < value(trial, "speed_ratio") < -0.97
    assert value(trial, "yaw_ratio") < 0


def test_exchanged_sides_turn_the_wrong_way() -> None:
    wheels = "".join(
        wheel(name, 0.2 if name[0] == "f" else -0.2, 0.25 if name in LEFT else -0.25)
        for name in (*LEFT, *RIGHT)
    )
    trial = sound(sdf(chassis() + wheels + diff_drive(RIGHT, LEFT)))
    assert 0.97 < value(trial, "speed_ratio") < 1.03
    assert value(trial, "yaw_ratio") < -0.1


_BALL = """
<link name="ball"><pose>-0.2 0 0.05 0 0 0</pose><inertial><mass>0.5</mass></inertial>
  <collision name="c"><geometry><sphere><radius>0.05</radius></sphere></geometry>
  <surface><friction><ode><mu>{mu}</mu><mu2>{mu}</mu2></ode></friction></surface></collision></link>
<joint name="ball_joint" type="fixed"><parent>base_link</parent><child>ball</child></joint>"""


def on_a_ball(mu: float) -> Robot:
    """Return a robot on two wheels and a ball behind them, which carries a quarter of the body."""
    wheels = wheel("l", 0, 0.25) + wheel("r", 0, -0.25)
    ball = _BALL.format(mu=mu)
    return sdf(chassis(com="-0.05 0 0") + ball + wheels + diff_drive(("l",), ("r",)))


def test_two_wheels_and_a_ball_turn_as_told() -> None:
    trial = sound(on_a_ball(0.0))
    assert 0.97 < value(trial, "yaw_ratio") < 1.03
    assert 0.9 < value(trial, "yaw_of_predicted") < 1.1


@pytest.mark.slow
def test_the_drag_of_a_ball_is_its_load_times_its_friction() -> None:
    (drag,) = trial_of(on_a_ball(0.0)).all("drag")
    assert drag.value < 1e-5
    (drag,) = trial_of(on_a_ball(0.5)).all("drag")
    robot = on_a_ball(0.5)
    weights = {link.name.value: link.mass for link in robot.links}
    total = sum(weights.values())
    # The ball stands 0.2 m behind the wheels' axle.
    share = (weights["base_link"] * 0.05 + weights["ball"] * 0.2) / 0.2 / total
    assert drag.part == "ball"
    assert abs(drag.value / (0.5 * share) - 1.0) < 0.01


def test_a_wheel_off_the_ground_carries_nothing() -> None:
    lifted = wheel("fl", 0.2, 0.25).replace("0.2 0.25 0.1 0 0 0", "0.2 0.25 0.15 0 0 0")
    rest = wheel("fr", 0.2, -0.25) + wheel("rl", -0.2, 0.25) + wheel("rr", -0.2, -0.25)
    trial = sound(sdf(chassis(com="-0.1 -0.05 0") + lifted + rest + diff_drive(LEFT, RIGHT)))
    assert value(trial, "load_share", "fl_joint") < 0.05
    assert value(trial, "load_share", "rr_joint") > 0.5


def test_joints_named_twice_or_not_at_all_are_no_obstacle() -> None:
    wheels = "".join(
        wheel(name, 0.2 if name[0] == "f" else -0.2, 0.25 if name in LEFT else -0.25)
        for name in (*LEFT, *RIGHT)
    )
    drive = diff_drive((*LEFT, "fl", "nowhere"), RIGHT) + diff_drive(LEFT, RIGHT)
    trial = sound(sdf(chassis() + wheels + drive))
    assert 0.97 < value(trial, "speed_ratio") < 1.03


def test_two_halves_with_a_free_joint_between_drive_together() -> None:
    rear = chassis().replace("base_link", "rear").replace("<pose>0 0 0.15", "<pose>-0.6 0 0.15", 1)
    hinge = """
<joint name="bend" type="revolute"><parent>base_link</parent><child>rear</child>
  <axis><xyz>0 0 1</xyz></axis></joint>"""
    front = wheel("fl", 0, 0.25) + wheel("fr", 0, -0.25)
    back = wheel("rl", -0.6, 0.25, parent="rear") + wheel("rr", -0.6, -0.25, parent="rear")
    nose = """
<link name="nose"><pose>0.25 0 0.05 0 0 0</pose><inertial><mass>0.5</mass></inertial>
  <collision name="c"><geometry><sphere><radius>0.05</radius></sphere></geometry>
  <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision></link>
<joint name="nose_joint" type="fixed"><parent>base_link</parent><child>nose</child></joint>"""
    drive = diff_drive(("fl",), ("fr",)) + diff_drive(("rl",), ("rr",))
    trial = sound(sdf(chassis(com="0.1 0 0") + rear + hinge + front + back + nose + drive))
    assert 0.97 < value(trial, "speed_ratio") < 1.03
    assert abs(value(trial, "path_sideways")) < 0.02


@pytest.mark.slow
def test_wheels_with_a_friction_direction_slide_sideways_in_a_turn() -> None:
    surface = "<surface><friction><ode><mu>0.5</mu><mu2>1</mu2>{}</ode></friction></surface>"

    def turned(direction: str) -> float:
        shape = "</sphere></geometry>"
        text = rover(0.15).replace(shape, shape + surface.format(direction))
        (robot,) = read_sdf(document(text), lambda _: "is not available")
        trial = sound(robot)
        assert 0.8 < value(trial, "yaw_of_predicted") < 1.2
        return value(trial, "yaw_ratio")

    assert turned("<fdir1>0 1 0</fdir1>") > 0.8
    assert turned("") < 0.65


@pytest.mark.slow
def test_a_wheel_with_a_friction_direction_may_lie_flat() -> None:
    surface = "<surface><friction><ode><mu>0.5</mu><mu2>1</mu2><fdir1>0 0 1</fdir1></ode>"
    shape = "</sphere></geometry>"
    text = rover(0.15).replace(shape, f"{shape}{surface}</friction></surface>")
    flat = text.replace("<xyz>0 1 0</xyz>", "<xyz>0 0 1</xyz>")
    (robot,) = read_sdf(document(flat), lambda _: "is not available")
    assert not trial_of(robot).trouble
