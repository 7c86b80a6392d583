"""A robot that gains energy while nothing drives it.

Only a simulation creates energy: a part of a robot that is fixed to the world starts inside the
ground, or stiff parts in a loop work against each other. The robot twitches, jumps or creeps.

Fix: check parts that start inside the ground or inside others.
Source: kinetic and potential energy at rest, as a share of the energy that lifts the robot by 0.1
m.
"""

from checker.physics.trial.robot_trial import SettledTrial
from checker.physics.trial.trial import too_weak
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import rover_with


@rule("TRI017", "gains-energy", Severity.WARNING, Concern.ROBOT, judges=("energy_gain",))
def check(driven: SettledTrial, *, warning_above: float = 0.1) -> Findings:
    """Report a gain of energy while nothing drives the robot.

    Options:
        warning_above: Energy gained, as a share of the energy that lifts the robot by 0.1 m; more
            is reported (0.1 means a lift of 10 mm).
    """
    if too_weak(driven.trial.measurements):
        return  # motors that are too weak drop parts and raise them again; TRI009 reports these
    gain = driven.trial.value("energy_gain")
    if gain is not None and gain > warning_above:
        yield finding(
            driven.robot,
            f"without a command the robot gains the energy of a lift by {gain * 0.1:.2g} m, "
            f"expected at most {warning_above * 0.1:g} m",
            key="energy_gain",
        )


def _flap(height: float, mark: str = "") -> dict[str, object]:
    """A rover that is fixed to the world, with a loose flap at a height."""
    added = f"""
<link name="flap">
  <pose>0.5 0 {height} 0 0 0</pose>
  <inertial><mass>2</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>0.05</radius></sphere></geometry></collision>
</link>
<joint name="hinge" type="revolute">
  <pose>-0.3 0 0 0 0 0</pose>
  <parent>base_link</parent><child>flap</child>
  <axis><xyz>0 -1 0</xyz></axis>
</joint>
<joint name="anchor" type="fixed"><parent>world</parent><child>base_link</child></joint>
"""
    return rover_with(added, mark)


GOOD = [_flap(0.2)]
BAD = [_flap(-0.05, "  <!-- ^ TRI017 -->")]
