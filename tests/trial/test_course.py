"""The course against the limits of plugins, and what limiters let through."""

from __future__ import annotations

import itertools
import math

from hypothesis import given
from hypothesis import strategies as st
from msgspec import convert, to_builtins

from checker.physics.trial.course import driving_legs, gentle_speed, linear_command
from checker.physics.trial.drivers.plans import plan_of
from checker.physics.trial.plan import Plan
from checker.physics.trial.profile import Limits, mix_lines, value_at
from tests.trial.machines import four_wheels, tracks

limits = st.builds(
    Limits,
    slowest=st.floats(-20, 0),
    fastest=st.floats(0, 20) | st.just(math.inf),
    braking=st.floats(-20, 0) | st.just(-math.inf),
    speeding=st.floats(0, 20) | st.just(math.inf),
)


def test_the_speed_of_the_drive_is_half_the_limit_within_bounds() -> None:
    assert gentle_speed(1.2) == 0.6
    assert gentle_speed(0.3) == 0.2
    assert gentle_speed(0.1) == 0.1
    assert gentle_speed(9.0) == 1.0
    assert gentle_speed(math.inf) == 0.5


@given(limits)
def test_commands_keep_the_limits(limit: Limits) -> None:
    knots = linear_command(driving_legs(limit, (0.0, 0.5)), limit)
    for (t0, v0), (t1, v1) in itertools.pairwise(knots):
        assert t1 >= t0
        assert limit.slowest - 1e-9 <= v1 <= limit.fastest + 1e-9
        if t1 - t0 > 1e-9:
            rise = (v1 - v0) / (t1 - t0)
            assert limit.braking * (1 + 1e-6) - 1e-6 <= rise <= limit.speeding * (1 + 1e-6) + 1e-6


@given(limits)
def test_the_course_is_short_whatever_the_limits(limit: Limits) -> None:
    legs = driving_legs(limit, (0.0, 1.0))
    assert legs[-1].end < 40
    assert all(leg.end > leg.start for leg in legs)


def test_legs_follow_one_another() -> None:
    legs = plan_of(four_wheels()).legs
    assert [leg.name for leg in legs] == [
        "settle",
        "drive",
        "stop after drive",
        "turn",
        "stop after turn",
        "full speed",
    ]
    assert [leg.end for leg in legs[:-1]] == [leg.start for leg in legs[1:]]
    assert legs[-1].end == 15.0


def test_without_limits_nothing_is_compared_with_them() -> None:
    plan = plan_of(four_wheels(limits=""))
    assert plan.speed_limit is None
    assert plan.acceleration_limit is None


def test_commands_that_are_no_numbers_are_none() -> None:
    assert mix_lines((((0.0, 1.0),),), lambda v: v / 1e-320 * 0.0 + math.nan) == ((0.0, 0.0),)
    assert value_at((), 1.0) == 0.0


def test_a_wheel_of_radius_0_stands_still() -> None:
    plan = plan_of(four_wheels(plugin_radius=0.0))
    assert all(speed == 0.0 for knots in plan.speeds.values() for _, speed in knots)


def test_a_plan_goes_through_json() -> None:
    import json

    for robot in (four_wheels(), tracks()):
        plan = plan_of(robot)
        again = convert(json.loads(json.dumps(to_builtins(plan))), Plan)
        assert json.dumps(to_builtins(again)) == json.dumps(to_builtins(plan))
