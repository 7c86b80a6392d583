"""Robots on tracks, as gz-sim's TrackedVehicle drives them."""

from __future__ import annotations

import pytest

from tests.trial.machines import sound, tracks, value


def test_belts_drive_straight_at_the_commanded_speed() -> None:
    trial = sound(tracks())
    assert 0.97 < value(trial, "speed_ratio") < 1.03
    assert abs(value(trial, "path_sideways")) < 0.01
    assert value(trial, "stop_speed") < 1e-3


def test_belts_turn_as_their_contacts_predict() -> None:
    trial = sound(tracks())
    assert value(trial, "yaw_rate") > 0.05
    assert 0.8 < value(trial, "yaw_of_predicted") < 1.2


def test_steering_efficiency_makes_up_for_slip() -> None:
    plain, helped = sound(tracks()), sound(tracks(efficiency=0.5))
    ratio = value(helped, "yaw_ratio") / value(plain, "yaw_ratio")
    assert ratio == pytest.approx(2.0, rel=0.15)


def test_a_belt_whose_link_faces_backwards_and_upside_down_still_drives_ahead() -> None:
    pi = "3.141592653589793"
    trial = sound(tracks(y_axis=f"{pi} 0 {pi}"))
    assert 0.97 < value(trial, "speed_ratio") < 1.03


def test_a_belt_whose_axis_points_the_other_way_drives_back() -> None:
    trial = sound(tracks(y_axis="0 0 3.141592653589793"))
    assert abs(value(trial, "speed_ratio")) < 0.2
    assert abs(value(trial, "path_heading")) > 0.2
