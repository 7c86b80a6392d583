"""A legged robot or an arm that does not hold its initial pose.

With its joints held in their initial position, the robot sinks, tips or gives way: it cannot stand
in this pose. This does not test whether the robot walks.

Fix: check the initial pose, the collisions of the feet and the centre of mass.
Source: experience; a position and velocity controller holds each joint.
"""

import math

from checker.base.words import beyond
from checker.model.locomotion.balancing import NOT_RUN
from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, Unchecked, finding, rule


@rule(
    "TRI011",
    "pose-not-held",
    Severity.WARNING,
    Concern.ROBOT,
    judges=("hold_sag", "hold_sink", "hold_tilt"),
)
def check(
    driven: SettledTrial,
    *,
    hold_sag_above: float = 0.1,
    hold_sink_above: float = 0.05,
    hold_tilt_above: float = 0.17,
) -> Findings:
    """Report joints that give way, and a robot that sinks or tilts.

    Options:
        hold_sag_above: Radians (sliding joints: metres) that a joint may move from its start by the
            end of the hold; more is reported.
        hold_sink_above: Metres that the robot may sink after settling, while its joints are held
            for 4 s; more is reported.
        hold_tilt_above: Radians between the robot's z axis and the vertical at the end of the hold;
            more is reported.
    """
    if driven.robot.balances:
        yield Unchecked(NOT_RUN, Severity.WARNING)
        return
    for sag in driven.trial.all("hold_sag"):
        if abs(sag.value) > hold_sag_above:
            yield finding(
                driven.part(sag.part),
                f"joint {sag.part!r} gives way by {_amount(driven, sag.part, sag.value)} while the "
                "robot holds its pose",
                key="hold_sag",
                covered_by=("TRI009",),
            )
    symptoms = {}
    sink, tilt = driven.trial.value("hold_sink"), driven.trial.value("hold_tilt")
    if sink is not None and sink > hold_sink_above:
        by = beyond(sink, hold_sink_above)
        symptoms["hold_sink"] = f"sinks by {by} m (at most {hold_sink_above:g} m)"
    if tilt is not None and tilt > hold_tilt_above:
        limit = round(math.degrees(hold_tilt_above), 1)
        by = beyond(math.degrees(tilt), limit)
        symptoms["hold_tilt"] = f"tilts by {by}° (at most {limit:g}°)"
    if symptoms:
        yield finding(
            driven.robot,
            "with its joints held in their initial position, the robot "
            f"{' and '.join(symptoms.values())}",
            key=" ".join(symptoms),
        )


def _amount(driven: SettledTrial, name: str, value: float) -> str:
    joint = driven.robot.joints_by_name.get(name)
    slides = joint is not None and joint.type.value == "prismatic"
    return f"{abs(value):.2g} m" if slides else f"{math.degrees(abs(value)):.0f}°"


def _stool(toe: float, mark: str = "") -> str:
    """A body on two stiff, jointed legs with toes of so many metres below their front ends."""
    legs = "".join(
        f"""
<link name="{side}_leg">
  <pose>-0.05 {y} 0.15 0 0 0</pose>
  <inertial><mass>0.5</mass>
    <inertia><ixx>4e-3</ixx><iyy>4e-3</iyy><izz>1e-3</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.3 0.05 0.3</size></box></geometry></collision>
  <collision name="toe">
    <pose>0.14 0 -0.15 0 0 0</pose>
    <geometry><box><size>0.02 0.05 {2 * toe}</size></box></geometry>
  </collision>
</link>
<joint name="{side}_hip" type="revolute">
  <pose>0 0 0.15 0 0 0</pose>
  <parent>base_link</parent><child>{side}_leg</child>
  <axis><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis>
</joint>
"""
        for side, y in (("left", 0.15), ("right", -0.15))
    )
    return f"""
<sdf version="1.6">
<model name="acme_walker_sensor_config_1">{mark}
<link name="base_link">
  <pose>0 0 0.35 0 0 0</pose>
  <inertial><mass>5</mass>
    <inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.4 0.2 0.1</size></box></geometry></collision>
</link>
{legs}
</model>
</sdf>
"""


GOOD = [_stool(0.01)]
BAD = [_stool(0.06, "  <!-- ^ TRI011 -->")]
