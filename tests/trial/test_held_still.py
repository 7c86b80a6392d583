"""What nothing moves stays: robots on a slope, and a screw."""

from __future__ import annotations

import math

import numpy as np
import pytest

from checker.model.robot import Robot
from checker.physics.trial.drivers.plans import plan_of
from checker.physics.trial.mjcf.scene import build_scene
from checker.physics.trial.simulation.rig import Rig
from tests.model.robots import sdf
from tests.trial.machines import STEP, box_inertia, four_wheels, friction, sound, tracks

SLOPE = math.radians(20)
DOWN, ASIDE = 0.0, math.pi / 2
"""Directions of the slope from the robot's x axis, radians."""


def block(mu: float) -> Robot:
    return sdf(f"""
<link name="base_link"><pose>0 0 0.1 0 0 0</pose>
  <inertial><mass>20</mass>{box_inertia(20, 0.5, 0.5, 0.2)}</inertial>
  <collision name="c"><geometry><box><size>0.5 0.5 0.2</size></box></geometry>{friction(mu)}
  </collision></link>""")


def creep(robot: Robot, direction: float = DOWN) -> float:
    """Return how far a robot comes in 5 s on a slope, metres, once it has stood there for 1 s."""
    plan = plan_of(robot)
    belts = [belt.link for belt in plan.belts]
    rig = Rig(build_scene(robot, servos=(*plan.speeds, *plan.places), belts=belts), plan, STEP)
    along, down = 9.81 * math.sin(SLOPE), 9.81 * math.cos(SLOPE)
    rig.model.opt.gravity[:] = along * math.cos(direction), along * math.sin(direction), -down
    places = []
    for seconds in (1.0, 5.0):
        for _ in range(round(seconds / STEP)):
            rig.step()
        places.append(rig.pose()[0][:2].copy())
    return float(np.linalg.norm(places[1] - places[0]))


@pytest.mark.parametrize(
    ("robot", "direction"),
    [
        (block(1.0), DOWN),
        (tracks(), DOWN),
        (tracks(), ASIDE),
        (four_wheels(), ASIDE),
    ],
    ids=["block", "tracks", "tracks aside", "wheels aside"],
)
def test_friction_holds_robots_on_a_slope_to_a_millimetre(robot: Robot, direction: float) -> None:
    assert creep(robot, direction) < 1e-3


def test_too_little_friction_holds_nothing() -> None:
    """From rest, 5 s at g (sin 20° − 0.3 cos 20°), after 1 s on the way."""
    rate = 9.81 * (math.sin(SLOPE) - 0.3 * math.cos(SLOPE))
    assert creep(block(0.3)) == pytest.approx(rate * (6**2 - 1**2) / 2, rel=0.03)


def test_the_servos_of_wheels_yield_on_a_slope() -> None:
    """A servo lets its wheel run at 1 ms times the acceleration that it holds: docs/trial.md."""
    assert creep(four_wheels()) / 5 == pytest.approx(9.81 * math.sin(SLOPE) * 1e-3, rel=0.1)


def test_a_screw_is_held_fixed_and_the_notes_say_so() -> None:
    body = "<inertial><mass>2</mass></inertial>"
    robot = sdf(f"""
<link name="base_link"><pose>0 0 0.1 0 0 0</pose>{body}
  <collision name="c"><geometry><box><size>0.5 0.5 0.2</size></box></geometry></collision></link>
<link name="nut"><pose>0 0 0.5 0 0 0</pose>{body}</link>
<joint name="spindle" type="screw"><parent>base_link</parent><child>nut</child>
  <thread_pitch>-100</thread_pitch><axis><xyz>0 0 1</xyz></axis></joint>""")
    trial = sound(robot)
    assert trial.notes[0] == "Joints of type 'screw' are held fixed: spindle."
    assert trial.replay is not None
    assert trial.replay.carriers["nut"] == "base_link"
    height = trial.replay.poses["base_link"][-5]
    assert height == pytest.approx(0.1, abs=5e-4)
