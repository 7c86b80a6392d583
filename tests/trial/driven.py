"""Trials made up for tests of the rules: a small rover and the figures that one wants."""

from __future__ import annotations

from inspect import signature
from typing import Any

from checker.model.locomotion.locomotion import DriveKind
from checker.model.robot import Robot
from checker.physics.trial.measures.figures import MEASURES
from checker.physics.trial.robot_trial import RobotTrial
from checker.physics.trial.trial import Leg, Measurement, Trial
from checker.rule import Context, Finding, Rule
from tests.model.robots import sdf

LEGS = (
    Leg("settle", 0.0, 2.0),
    Leg("drive", 2.0, 6.0, linear=0.5),
    Leg("stop after drive", 6.0, 7.5),
    Leg("turn", 7.5, 11.5, angular=1.0),
)

_WHEEL = """
<link name="{name}"><pose>{x} {y} 0.1 0 0 0</pose>
<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link>
<joint name="{name}_joint" type="revolute"><parent>base_link</parent><child>{name}</child>
<axis><xyz>{axis}</xyz></axis></joint>"""


def rover(
    *, left: str = "left", right: str = "right", axis: str = "0 1 0", wheel_radius: float = 0.1
) -> Robot:
    """Return a robot on four wheels whose drive names the wheels of `left` as its left ones."""
    places = {"left": 0.2, "right": -0.2}
    wheels = "".join(
        _WHEEL.format(name=f"{side}_{end}", x=x, y=y, axis=axis)
        for side, y in places.items()
        for end, x in (("front", 0.2), ("rear", -0.2))
    )
    named = "".join(
        f"<{tag}_joint>{side}_{end}_joint</{tag}_joint>"
        for tag, side in (("left", left), ("right", right))
        for end in ("front", "rear")
    )
    return sdf(
        f'<link name="base_link"/>{wheels}<plugin filename="d" '
        f'name="ignition::gazebo::systems::DiffDrive">{named}'
        "<wheel_separation>0.4</wheel_separation>"
        f"<wheel_radius>{wheel_radius}</wheel_radius></plugin>"
    )


def trial_of(*measurements: Measurement, **changes: Any) -> Trial:
    """Return a trial with figures of single parts, and those of the robot by keyword."""
    figures = {name: changes.pop(name) for name in list(changes) if name in MEASURES}
    of_robot = tuple(Measurement(name, value) for name, value in figures.items())
    plain = {"drive": str(DriveKind.SKID_STEER), "legs": LEGS, **changes}
    return Trial(measurements=(*measurements, *of_robot), **plain)


def said_by(rule: Rule, trial: Trial, robot: Robot | None = None) -> list[Finding]:
    """Return what a rule says about a trial of a rover that has no sheet."""
    more = {"specification": None, "context": Context()}
    asked = {name: it for name, it in more.items() if name in signature(rule.check).parameters}
    found = list(rule.check(RobotTrial(robot or rover(), trial), **asked))
    assert all(isinstance(each, Finding) for each in found)
    return [each for each in found if isinstance(each, Finding)]
