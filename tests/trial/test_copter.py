"""Copters: what their rotors give decides whether they hover."""

from __future__ import annotations

import math

import pytest

from checker.model.robot import Robot
from tests.model.robots import sdf
from tests.trial.machines import box_inertia, elements, plugin, sound, value

MASS, FASTEST = 2.0, 800.0
CONSTANT = 2.5 * 9.81 * MASS / 4 / FASTEST**2
"""Of four rotors that together lift 2.5 times the weight."""


def copter(
    *,
    constant: float = CONSTANT,
    believed: float | None = None,
    com: str = "0 0 0",
    count: int = 4,
    spins: str = "",
    weak: int = -1,
) -> Robot:
    body = f"""
<link name="base_link"><pose>0 0 0.05 0 0 0</pose>
  <inertial><pose>{com} 0 0 0</pose><mass>{MASS}</mass>{box_inertia(MASS, 0.3, 0.3, 0.1)}</inertial>
  <collision name="c"><geometry><box><size>0.3 0.3 0.1</size></box></geometry></collision></link>"""
    entries, rotors = "", ""
    for number in range(count):
        angle = 2 * math.pi * (number + 0.5) / count
        spin = spins[number] if spins else "+-"[number % 2]
        own = constant * (0.4 if number == weak else 1.0)
        body += f"""
<link name="r{number}"><pose>{0.25 * math.cos(angle)} {0.25 * math.sin(angle)} 0.1 0 0 0</pose>
  <inertial><mass>0.005</mass>{box_inertia(0.005, 0.2, 0.02, 0.005)}</inertial></link>
<joint name="r{number}_joint" type="revolute"><parent>base_link</parent><child>r{number}</child>
  <axis><xyz>0 0 1</xyz><limit><lower>-1e16</lower><upper>1e16</upper></limit></axis></joint>"""
        rotors += plugin(
            "MulticopterMotorModel",
            elements(
                {
                    "jointName": f"r{number}_joint",
                    "linkName": f"r{number}",
                    "turningDirection": "ccw" if spin == "+" else "cw",
                    "maxRotVelocity": FASTEST,
                    "motorConstant": own,
                    "momentConstant": 0.016,
                    "motorNumber": number,
                }
            ),
        )
        entry = {
            "jointName": f"r{number}_joint",
            "forceConstant": own if believed is None else believed,
            "momentConstant": 0.016,
            "direction": 1 if spin == "+" else -1,
        }
        entries += f"<rotor>{elements(entry)}</rotor>"
    control = plugin(
        "MulticopterVelocityControl", f"<rotorConfiguration>{entries}</rotorConfiguration>"
    )
    return sdf(body + rotors + control)


def test_a_sound_copter_hovers_and_climbs() -> None:
    trial = sound(copter())
    assert value(trial, "thrust_to_weight") == pytest.approx(2.5 * MASS / (MASS + 0.02), rel=1e-3)
    assert value(trial, "hover_effort") == pytest.approx((MASS + 0.02) / MASS / 2.5, rel=1e-3)
    assert abs(value(trial, "hover_sink")) < 0.01
    assert value(trial, "hover_tilt") < 0.01
    assert value(trial, "climbed") == pytest.approx(1.0, abs=0.05)


def test_rotors_that_are_too_weak_do_not_carry_it() -> None:
    trial = sound(copter(constant=CONSTANT / 3))
    assert value(trial, "thrust_to_weight") < 1
    assert value(trial, "hover_effort") > 1
    assert value(trial, "hover_sink") > 0.3
    assert value(trial, "climbed") < 0.5


def test_a_controller_that_believes_in_more_thrust_than_there_is_sinks() -> None:
    trial = sound(copter(believed=2 * CONSTANT))
    assert value(trial, "hover_sink") > 0.3


@pytest.mark.slow
def test_a_centre_of_mass_to_the_side_asks_more_of_one_side() -> None:
    level, aside = sound(copter()), sound(copter(com="0.05 0 0"))
    # The arm of the rotors along x is 0.25 · cos 45°.
    share = 1 + 0.05 / (0.25 * math.cos(math.pi / 4)) * MASS / (MASS + 0.02)
    assert value(aside, "hover_effort") / value(level, "hover_effort") == pytest.approx(
        share, rel=0.02
    )
    assert abs(value(aside, "hover_sink")) < 0.02


def test_a_hexacopter_with_one_weak_arm_shares_the_load() -> None:
    trial = sound(copter(count=6, weak=2))
    assert value(trial, "hover_effort") < 0.5
    assert abs(value(trial, "hover_sink")) < 0.02


def test_rotors_that_all_spin_one_way_keep_no_balance() -> None:
    trial = sound(copter(spins="++++"))
    assert trial.value("hover_effort") is None


def test_on_the_ground_nothing_is_driven() -> None:
    trial = sound(copter())
    assert value(trial, "settle_rise") < 1e-3
    assert value(trial, "energy_gain") < 0.1
