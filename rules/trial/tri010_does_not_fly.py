"""A multicopter that cannot hover or climb.

The robot sinks at full throttle, or tips over: the rotors are too weak for the mass, are on one
side of the centre of mass, or some of them turn the wrong way.

Fix: compare `motorConstant` · `maxRotVelocity`² of all rotors with the weight, the poses of the
rotors with the centre of mass, and the turning directions with each other.
Source: a linear program for the thrusts that hold the weight at the centre of mass with the
smallest largest share of any rotor's thrust.
"""

import math

from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, finding, rule


@rule(
    "TRI010",
    "does-not-fly",
    Severity.ERROR,
    Concern.ROBOT,
    judges=("hover_effort", "hover_sink", "hover_tilt", "climbed"),
)
def check(
    driven: SettledTrial,
    *,
    hover_effort_above: float = 1.0,
    hover_sink_above: float = 0.2,
    hover_tilt_above: float = 0.26,
    climbed_below: float = 0.8,
) -> Findings:
    """Report a multicopter that lacks thrust, sinks, tilts or does not climb.

    Options:
        hover_effort_above: Share of its greatest thrust that the rotor with the highest load may
            need in a balanced hover; more is an error.
        hover_sink_above: Metres of height that the robot may lose in 4 s of hover; more is an
            error.
        hover_tilt_above: Radians between the robot's z axis and the vertical in the last second of
            hover; more is an error.
        climbed_below: Share of the commanded climb of 1 m; less is an error.
    """
    value = driven.trial.value
    symptoms = {}
    if (effort := value("hover_effort")) is not None and effort > hover_effort_above:
        symptoms["hover_effort"] = (
            f"needs {effort:.0%} of the thrust of its most loaded rotor to hover"
        )
    if (sink := value("hover_sink")) is not None and sink > hover_sink_above:
        symptoms["hover_sink"] = f"sinks by {sink:.2g} m in hover (at most {hover_sink_above:g} m)"
    if (tilt := value("hover_tilt")) is not None and tilt > hover_tilt_above:
        limit = math.degrees(hover_tilt_above)
        symptoms["hover_tilt"] = (
            f"tilts by {math.degrees(tilt):.0f}° in hover (at most {limit:.0f}°)"
        )
    if (climbed := value("climbed")) is not None and climbed < climbed_below:
        symptoms["climbed"] = (
            f"climbs {climbed:.0%} of the commanded height (at least {climbed_below:.0%})"
        )
    if symptoms:
        ratio = value("thrust_to_weight")
        strength = f"; all rotors together lift {ratio:.2f} times its weight" if ratio else ""
        yield finding(
            driven.drive,
            f"the robot {', '.join(symptoms.values())}{strength}",
            key=" ".join(symptoms),
        )


_ROTOR = """
<link name="{name}">
  <pose>{x} {y} 0.1 0 0 0</pose>
  <inertial><mass>0.01</mass>
    <inertia><ixx>1e-5</ixx><iyy>1e-5</iyy><izz>2e-5</izz></inertia></inertial>
</link>
<joint name="{name}_joint" type="revolute">
  <parent>base_link</parent><child>{name}</child><axis><xyz>0 0 1</xyz></axis>
</joint>
<plugin filename="librotor.so" name="ignition::gazebo::systems::MulticopterMotorModel">{mark}
  <jointName>{name}_joint</jointName><linkName>{name}</linkName>
  <turningDirection>{turn}</turningDirection><actuator_number>{number}</actuator_number>
  <motorNumber>{number}</motorNumber>
  <motorConstant>{strength}</motorConstant><momentConstant>0.016</momentConstant>
  <maxRotVelocity>800</maxRotVelocity><motorType>velocity</motorType>
</plugin>
"""
_PLACES = (("fr", 0.2, -0.2, "ccw"), ("rl", -0.2, 0.2, "ccw"), ("fl", 0.2, 0.2, "cw"),
           ("rr", -0.2, -0.2, "cw"))  # fmt: skip


def _copter(strength: float, mark: str = "") -> str:
    rotors = "".join(
        _ROTOR.format(
            name=name, x=x, y=y, turn=turn, number=number, strength=strength,
            mark="" if number else mark,
        )
        for number, (name, x, y, turn) in enumerate(_PLACES)
    )  # fmt: skip
    return f"""
<sdf version="1.6">
<model name="acme_copter_sensor_config_1">
<link name="base_link">
  <pose>0 0 0.1 0 0 0</pose>
  <inertial><mass>1.5</mass>
    <inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.04</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.4 0.4 0.1</size></box></geometry></collision>
</link>
{rotors}
</model>
</sdf>
"""


GOOD = [_copter(1.2e-5)]
BAD = [_copter(5e-6, "  <!-- ^ TRI010 -->")]
