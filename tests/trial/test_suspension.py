"""Loads and heights of six-wheelers, against statics; TRI007 for wheels that do not touch."""

from __future__ import annotations

import pytest

from checker.physics.trial.settling import unsettled_reason
from checker.rulebook.discovery import all_rules
from tests.model.robots import sdf
from tests.trial.driven import said_by
from tests.trial.machines import sound, value
from tests.trial.six_wheels import BODY, on_struts, on_trailing_arms, rigid, rocker_bogie

(TRI007,) = (rule for rule in all_rules() if rule.id == "TRI007")
WEIGHT = BODY * 9.81
"""Newtons on six springs."""
WHEELS = ("fl", "ml", "rl", "fr", "mr", "rr")


def loads(content: str) -> tuple[dict[str, float], list[str], float]:
    """Return each wheel's share of an equal load, what TRI007 reports, and how far it sinks."""
    robot = sdf(content, "1.7")
    trial = sound(robot)
    assert not unsettled_reason(trial)
    shares = {name: value(trial, "load_share", f"{name}_joint") for name in WHEELS}
    found = [each.message for each in said_by(TRI007, trial, robot)]
    heights = [z for t, z in zip(trial.series["time"], trial.series["z"], strict=True) if t < 1.99]
    return shares, found, -heights[-1]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("stiffness", "damping", "reference"),
    [
        (1e3, 100, 0.0),
        (5e3, 300, 0.0),
        (5e4, 1000, 0.0),
        (2e3, 200, -0.05),
        (2e3, 200, 0.05),
    ],
)
def test_springs_share_the_load_and_give_way_as_statics_say(
    stiffness: float, damping: float, reference: float
) -> None:
    shares, found, sink = loads(on_struts(stiffness, damping, reference))
    assert not found
    assert shares == pytest.approx(dict.fromkeys(WHEELS, 1.0), abs=0.03)
    assert sink == pytest.approx(reference + WEIGHT / 6 / stiffness, abs=5e-4)


@pytest.mark.slow
@pytest.mark.parametrize(
    "content",
    [
        on_trailing_arms(50, 5),
        on_trailing_arms(5e3, 50),
        on_trailing_arms(200, 20, 0.2),
        on_trailing_arms(200, 20, -0.2),
        rocker_bogie(),
    ],
)
def test_arms_on_springs_load_all_wheels(content: str) -> None:
    shares, found, _ = loads(content)
    assert not found
    # The largest of three stops: after the turn, friction holds the arms a little aside.
    assert shares == pytest.approx(dict.fromkeys(WHEELS, 1.0), abs=0.15)


def test_springs_reach_the_ground_with_wheels_that_are_higher() -> None:
    shares, found, _ = loads(on_struts(2e3, 200, lift=2e-3))
    assert not found
    # Two millimetres of spring are 4 N of the 49 N of a wheel, shared with the others.
    assert shares["ml"] == pytest.approx(1 - 2 / 3 * 2e3 * 2e-3 / (WEIGHT / 6 + 14.7), abs=0.01)


def test_strongly_damped_springs_reach_it_later() -> None:
    """The middle wheels are 30 mm higher; the body sinks to them at 5 mm/s."""
    shares, found, sink = loads(on_struts(1e3, 1e4, lift=0.03))
    assert sink == pytest.approx(0.0145, abs=0.002)
    assert not found
    assert shares["ml"] > 0.3


@pytest.mark.parametrize("content", [rigid(2e-3), on_struts(1e5, 1e3, lift=2e-3)])
def test_wheels_two_millimetres_above_the_ground_carry_nothing(content: str) -> None:
    shares, found, _ = loads(content)
    assert [message.split("'")[1] for message in found] == ["ml_joint", "mr_joint"]
    assert all("carries nothing" in message for message in found)
    assert shares["fl"] == pytest.approx(1.5, abs=0.01)


def test_rigid_axles_share_the_load() -> None:
    shares, found, _ = loads(rigid())
    assert not found
    assert sum(shares.values()) == pytest.approx(6.0, abs=0.01)
