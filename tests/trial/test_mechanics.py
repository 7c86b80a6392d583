"""Each figure changes as mechanics says when its cause changes."""

from __future__ import annotations

import math

import pytest

from checker.physics.trial.trial import Trial
from tests.trial.machines import four_wheels, sound, tracks, trial_of, value

GRAVITY = 9.81


def test_a_wheel_radius_that_the_plugin_gets_wrong_scales_the_speed() -> None:
    trial = sound(four_wheels(plugin_radius=0.2))
    assert value(trial, "speed_ratio") == pytest.approx(0.5, rel=0.02)


def test_half_the_separation_in_the_plugin_halves_the_turn() -> None:
    whole, half = (sound(four_wheels(plugin_separation=s)) for s in (0.5, 0.25))
    # With the same commanded rate; each plan chooses its own.
    ratio = value(half, "yaw_ratio") / value(whole, "yaw_ratio")
    assert ratio == pytest.approx(0.5, rel=0.1)


@pytest.mark.slow
def test_a_longer_wheel_base_turns_less() -> None:
    short, long = (sound(four_wheels(base=base)) for base in (0.3, 0.6))
    assert value(long, "yaw_ratio") < 0.8 * value(short, "yaw_ratio")


def test_turning_needs_torque_in_proportion_to_weight() -> None:
    light, heavy = (sound(four_wheels(mass=mass)) for mass in (20.0, 44.0))
    torques = [max(each.value for each in trial.all("torque")) for trial in (light, heavy)]
    assert torques[1] / torques[0] == pytest.approx(48 / 24, rel=0.1)


def test_turning_needs_torque_in_proportion_to_friction() -> None:
    slippery, rough = (sound(four_wheels(mu=mu)) for mu in (0.3, 0.6))
    torques = [_mean_of_turn(trial, "torque:fl_joint") for trial in (slippery, rough)]
    assert torques[1] / torques[0] == pytest.approx(2.0, rel=0.1)


def _mean_of_turn(trial: Trial, name: str) -> float:
    """The mean of a series while the robot turns steadily."""
    turn = next(leg for leg in trial.legs if leg.name == "turn")
    pairs = zip(trial.series["time"], trial.series[name], strict=True)
    steady = [each for time, each in pairs if turn.end - 1.5 <= time < turn.end]
    return sum(steady) / len(steady)


def test_friction_does_not_change_how_far_slipping_wheels_turn() -> None:
    slippery, rough = (sound(four_wheels(mu=mu)) for mu in (0.3, 0.6))
    assert value(slippery, "yaw_ratio") == pytest.approx(value(rough, "yaw_ratio"), rel=0.1)


def test_acceleration_ends_where_friction_does() -> None:
    limits = "<max_velocity>3</max_velocity><max_acceleration>20</max_acceleration>"
    trial = sound(four_wheels(mu=0.3, limits=limits))
    assert value(trial, "full_acceleration") == pytest.approx(0.3 * GRAVITY, rel=0.2)


def test_loads_follow_the_centre_of_mass() -> None:
    trial = sound(four_wheels(com="0.06 0 0"))
    front, rear = (value(trial, "load_share", f"{name}_joint") for name in ("fl", "rl"))
    # 20 of 24 kg stand 0.06 m ahead of the middle of a base of 0.4 m.
    moved = 2 * 0.06 * (20 / 24) / 0.4
    assert front == pytest.approx(1 + moved, abs=0.02)
    assert rear == pytest.approx(1 - moved, abs=0.02)


def test_the_centre_of_mass_is_found_beside_the_middle_of_the_wheels() -> None:
    trial = sound(four_wheels(com="0.06 -0.03 0"))
    assert value(trial, "com_offset_front") == pytest.approx(0.06 * 20 / 24, abs=1e-3)
    assert value(trial, "com_offset_side") == pytest.approx(-0.03 * 20 / 24, abs=1e-3)


def test_a_high_centre_of_mass_tips() -> None:
    low = sound(four_wheels(separation=0.3, base=0.2))
    high = trial_of(four_wheels(separation=0.3, base=0.2, com="0 0 3"))
    assert value(low, "tilt_max") < 0.05
    assert high.trouble or value(high, "tilt_max") > 0.5


@pytest.mark.parametrize("side", [0.055, -0.055])
def test_a_centre_of_mass_to_the_side_drifts_while_turning_and_explains_it(side: float) -> None:
    straight = sound(tracks(mu=0.5))
    aside = sound(tracks(mu=0.5, com=f"0 {side * 28 / 20} 0"))
    assert value(aside, "com_offset_side") == pytest.approx(side, abs=2e-3)
    assert value(straight, "turn_drift") < 0.1
    drift = value(aside, "turn_drift")
    assert drift > 3 * value(straight, "turn_drift")
    assert value(aside, "turn_drift_explained") == pytest.approx(drift, rel=0.35)


def test_half_the_time_step_measures_the_same() -> None:
    robot = four_wheels(com="0.03 0 0")
    whole, half = trial_of(robot), trial_of(robot, 0.001)
    for name in ("speed_ratio", "yaw_of_predicted", "settle_drop"):
        assert value(half, name) == pytest.approx(value(whole, name), rel=0.1)
    assert not math.isnan(value(half, "turn_drift"))
