"""What rotors lift and what they control, whatever their number and place."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.locomotion.locomotion import Rotor
from checker.model.locomotion.rotors import (
    controlled_motions,
    thrust_to_weight,
    yaw_imbalance,
)
from tests.model.robots import sdf

QUADROTOR = [(1.0, -1.0, "ccw"), (-1.0, 1.0, "ccw"), (1.0, 1.0, "cw"), (-1.0, -1.0, "cw")]

places = st.tuples(st.integers(-3, 3), st.integers(-3, 3), st.sampled_from(["ccw", "cw"]))


def rotors(
    layout: list[tuple[float, float, str]],
    *,
    constant: float = 8e-6,
    speed: float = 800.0,
    moment: float = 0.016,
) -> tuple[Rotor, ...]:
    parts = "".join(
        f"""
        <link name="rotor_{n}"><pose>{x} {y} 0 0 0 0</pose></link>
        <joint name="hub_{n}" type="revolute">
          <parent>body</parent><child>rotor_{n}</child><axis><xyz>0 0 1</xyz></axis>
        </joint>
        <plugin filename="m" name="any::MulticopterMotorModel">
          <jointName>hub_{n}</jointName><linkName>rotor_{n}</linkName>
          <turningDirection>{way}</turningDirection><motorNumber>{n}</motorNumber>
          <motorConstant>{constant!r}</motorConstant><momentConstant>{moment!r}</momentConstant>
          <maxRotVelocity>{speed!r}</maxRotVelocity>
        </plugin>"""
        for n, (x, y, way) in enumerate(layout)
    )
    return sdf(f'<link name="body"/>{parts}').locomotion.rotors


@given(
    number=st.integers(1, 8),
    constant=st.floats(1e-8, 1e-2),
    speed=st.floats(1.0, 1e4),
    mass=st.floats(0.01, 1e3),
)
def test_thrust_is_the_motor_constant_times_the_square_of_the_speed(
    number: int, constant: float, speed: float, mass: float
) -> None:
    layout = [(float(n), 0.0, "cw") for n in range(number)]
    ratio = thrust_to_weight(rotors(layout, constant=constant, speed=speed), mass)
    assert ratio == pytest.approx(number * constant * speed**2 / (mass * 9.8))


@pytest.mark.parametrize("mass", [0.0, -1.0, math.inf, math.nan])
def test_without_a_weight_there_is_no_ratio(mass: float) -> None:
    assert thrust_to_weight(rotors(QUADROTOR), mass) is None


def test_a_thrust_beyond_all_numbers_has_no_ratio() -> None:
    assert thrust_to_weight(rotors(QUADROTOR, constant=1e300, speed=1e300), 1.0) is None
    assert thrust_to_weight((), 1.0) is None


def test_torques_cancel_when_as_many_rotors_turn_either_way() -> None:
    assert yaw_imbalance(rotors(QUADROTOR)) == pytest.approx(0)
    assert yaw_imbalance(rotors([(x, y, "cw") for x, y, _ in QUADROTOR])) == pytest.approx(1)
    assert yaw_imbalance(rotors(QUADROTOR[:3])) == pytest.approx(1 / 3)
    assert yaw_imbalance(rotors([(0.0, 0.0, "left")])) is None


@pytest.mark.parametrize(
    ("ways", "motions"),
    [
        (["ccw", "ccw", "cw", "cw"], 4),
        (["ccw", "cw", "ccw", "cw"], 3),
        (["cw", "cw", "cw", "cw"], 3),
    ],
    ids=["neighbours opposite", "pitch turns it too", "all one way"],
)
def test_a_quadrotor_needs_neighbours_that_turn_opposite(ways: list[str], motions: int) -> None:
    layout = [(x, y, way) for (x, y, _), way in zip(QUADROTOR, ways, strict=True)]
    assert controlled_motions(rotors(layout)) == motions


@given(st.lists(places, min_size=1, max_size=8))
def test_controlled_motions_are_the_rank_of_the_allocation_matrix(
    layout: list[tuple[int, int, str]],
) -> None:
    matrix = [[1, x, y, 1 if way == "ccw" else -1] for x, y, way in layout]
    found = controlled_motions(rotors([(float(x), float(y), way) for x, y, way in layout]))
    assert found == np.linalg.matrix_rank(np.array(matrix, dtype=float))


@pytest.mark.parametrize("far", ["1e308", "inf", "x"])
def test_hostile_places_say_nothing_or_something(far: str) -> None:
    layout = [(far, "-1", "cw"), (far, "1", "ccw"), ("-1e308", "1", "cw"), ("0", "0", "ccw")]
    found = controlled_motions(rotors(layout))  # type: ignore[arg-type]
    assert found is None or 0 < found <= 4
