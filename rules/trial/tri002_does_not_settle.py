"""A robot that does not come to rest when it is put down.

It sinks, tips, jumps, slides or folds up before anything is asked of it, so nothing that it does
afterwards means anything. Mostly a collision shape is missing or stands askew, parts start inside
each other, or the inertia of a part is far too small.

Fix: look at the collision shapes and inertias of the parts that touch the ground first.
Source: experience; the robot is put down from 10 mm above the ground and left alone for 2 s.
"""

import math
from collections.abc import Iterator

from checker.physics.trial.robot_trial import RobotTrial
from checker.physics.trial.trial import Trial
from checker.rule import Findings, Severity, finding, rule


@rule("TRI002", "does-not-settle", Severity.ERROR)
def check(
    driven: RobotTrial,
    *,
    settle_drop_above: float = 0.1,
    settle_rise_above: float = 0.05,
    settle_shift_above: float = 0.1,
    settle_tilt_above: float = 0.26,
    settle_speed_above: float = 0.05,
    rest_penetration_above: float = 0.05,
) -> Findings:
    """Report a robot that moves further than these limits while it settles.

    Options:
        settle_drop_above: Metres that the robot's origin may sink from where it is put, 0.01 m of
            which is the fall to the ground; more is an error.
        settle_rise_above: Metres that the robot's origin may rise above where it is put; more is an
            error.
        settle_shift_above: Metres that the robot's origin may have moved sideways after 2 s; more
            is an error.
        settle_tilt_above: Radians between the robot's z axis and the vertical, on average over the
            last 0.5 s; more is an error.
        settle_speed_above: Speed of the robot's origin in m/s, on average over the last 0.5 s; more
            is an error.
        rest_penetration_above: Metres that the deepest contact may lie in the ground in the last
            0.5 s; more is an error.
    """
    limits = {
        "settle_drop": settle_drop_above,
        "settle_rise": settle_rise_above,
        "settle_shift": settle_shift_above,
        "settle_tilt": settle_tilt_above,
        "settle_speed": settle_speed_above,
        "rest_penetration": rest_penetration_above,
    }
    said = dict(_symptoms(driven.trial, limits))
    if said:
        yield finding(
            driven.robot,
            f"put down from 10 mm above the ground and left alone, it {', '.join(said.values())}",
            key=" ".join(said),
        )


def _symptoms(trial: Trial, limits: dict[str, float]) -> Iterator[tuple[str, str]]:
    for name, limit in limits.items():
        value = trial.value(name)
        if value is None or value <= limit:
            continue
        if name == "settle_tilt":
            said = f"tilts by {math.degrees(value):.0f}° (at most {math.degrees(limit):.0f}°)"
        elif name == "settle_speed":
            said = f"still moves at {value:.2g} m/s (at most {limit:g} m/s)"
        else:
            said = f"{_VERBS[name]} {value:.3g} m (at most {limit:g} m)"
        yield name, said


_VERBS = {
    "settle_drop": "drops",
    "settle_rise": "jumps up",
    "settle_shift": "slides",
    "rest_penetration": "sinks into the ground by",
}


def _box(height: float, mark: str = "") -> str:
    return f"""
<sdf version="1.6">
<model name="acme_box_sensor_config_1">{mark}
<link name="base_link">
  <inertial>
    <pose>0.2 0 {height} 0 0 0</pose>
    <mass>5</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>
  </inertial>
  <collision name="c"><geometry><box><size>0.3 0.3 0.3</size></box></geometry></collision>
</link>
</model>
</sdf>
"""


GOOD = [_box(-0.5).replace("0.2 0 -0.5", "0 0 0")]
BAD = [_box(0.1, "  <!-- ^ TRI002 -->")]
