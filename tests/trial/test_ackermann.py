"""Robots that steer, on a circle."""

from __future__ import annotations

import math

import pytest

from checker.model.robot import Robot
from checker.physics.trial.drivers.plans import plan_of
from checker.physics.trial.profile import value_at
from tests.model.robots import sdf
from tests.trial.machines import (
    box_inertia,
    chassis,
    elements,
    plugin,
    sound,
    trial_of,
    value,
    wheel,
)

BASE, SEPARATION = 0.5, 0.4


def car(*, axis: str = "0 0 1", base: float = BASE, limit: float = 0.5) -> Robot:
    knuckles = "".join(
        f"""
<link name="k{side}"><pose>{BASE} {y} 0.1 0 0 0</pose>
  <inertial><mass>0.2</mass>{box_inertia(0.2, 0.05, 0.05, 0.05)}</inertial></link>
<joint name="k{side}_joint" type="revolute"><parent>base_link</parent><child>k{side}</child>
  <axis><xyz>{axis}</xyz><limit><lower>-0.6</lower><upper>0.6</upper><effort>5</effort></limit>
  </axis></joint>"""
        + wheel(f"f{side}", BASE, y, parent=f"k{side}")
        + wheel(f"r{side}", 0, y)
        for side, y in (("l", SEPARATION / 2), ("r", -SEPARATION / 2))
    )
    names = {
        "left_joint": ("fl_joint", "rl_joint"),
        "right_joint": ("fr_joint", "rr_joint"),
        "left_steering_joint": ("kl_joint",),
        "right_steering_joint": ("kr_joint",),
    }
    joints = "".join(f"<{tag}>{name}</{tag}>" for tag, all in names.items() for name in all)
    sizes = elements(
        {
            "wheel_separation": SEPARATION,
            "kingpin_width": SEPARATION,
            "wheel_base": base,
            "steering_limit": limit,
            "wheel_radius": 0.1,
            "max_velocity": 1,
            "min_velocity": -1,
        }
    )
    return sdf(
        chassis(com=f"{BASE / 2} 0 0") + knuckles + plugin("AckermannSteering", joints + sizes)
    )


def test_a_car_drives_straight_and_on_its_circle() -> None:
    trial = sound(car())
    assert trial.drive == "Ackermann steering"
    assert 0.97 < value(trial, "speed_ratio") < 1.03
    assert abs(value(trial, "path_sideways")) < 5e-3
    assert 0.95 < value(trial, "yaw_ratio") < 1.05
    assert 0.95 < value(trial, "yaw_of_predicted") < 1.05


def test_a_circle_is_no_drift() -> None:
    assert sound(car()).value("turn_drift") is None


def test_a_steering_axis_that_points_down_steers_the_other_way() -> None:
    assert value(trial_of(car(axis="0 0 -1")), "yaw_ratio") < -0.2


@pytest.mark.slow
def test_a_wrong_wheel_base_makes_another_circle() -> None:
    assert value(sound(car(base=0.5 * BASE)), "yaw_ratio") < 0.75
    assert value(sound(car(base=1.5 * BASE)), "yaw_ratio") > 1.2


def test_without_steering_limit_it_goes_straight() -> None:
    assert abs(value(sound(car(limit=0.0)), "yaw_ratio")) < 0.02


def test_the_steered_wheels_turn_about_one_point() -> None:
    plan = plan_of(car())
    turn = next(leg for leg in plan.legs if leg.name == "turn")
    now = turn.end - 0.1
    angles = {name: value_at(plan.places[f"k{name}_joint"], now) for name in ("l", "r")}
    speeds = {name: value_at(knots, now) for name, knots in plan.speeds.items()}
    radius = BASE / math.tan(angles["l"]) + SEPARATION / 2
    assert radius == pytest.approx(BASE / math.tan(angles["r"]) - SEPARATION / 2)
    assert max(angles.values()) < 0.5
    ways = {"l": radius - SEPARATION / 2, "r": radius + SEPARATION / 2}
    for name, speed in speeds.items():
        assert speed * 0.1 == pytest.approx(turn.linear * ways[name[1]] / radius)
