"""A robot that does not come to rest.

The robot sinks, tips, jumps, slides or folds up before any command, so all later measurements are
meaningless: how it drives is then not checked. Usually a collision is missing or tilted, parts
start inside each other, or the inertia of a part is far too small. Outside of SubT, only robots
that drive are checked: others may be fixed by the model that includes them. A robot whose name says
that it balances, or that stands on two wheels at the ends of legs or of one axle alone, falls
without its controller: no rule checks how it drives.

Fix: check first the collisions and inertias of the parts that touch the ground.
Source: experience; the robot starts 10 mm above the ground and gets no command for 2 s.
"""

from checker.model.locomotion.balancing import NOT_RUN
from checker.physics.trial.robot_trial import RobotTrial
from checker.physics.trial.settling import SETTLE_LIMITS, excess_figures
from checker.rule import Concern, Context, Findings, Severity, Unchecked, finding, rule, unchecked


@rule(
    "TRI002",
    "does-not-settle",
    Severity.ERROR,
    Concern.ROBOT,
    judges=(
        "settle_drop",
        "settle_rise",
        "settle_shift",
        "settle_tilt",
        "settle_speed",
        "rest_penetration",
    ),
)
def check(
    driven: RobotTrial,
    context: Context,
    *,
    settle_drop_above: float = SETTLE_LIMITS["settle_drop"],
    settle_rise_above: float = SETTLE_LIMITS["settle_rise"],
    settle_shift_above: float = SETTLE_LIMITS["settle_shift"],
    settle_tilt_above: float = SETTLE_LIMITS["settle_tilt"],
    settle_speed_above: float = SETTLE_LIMITS["settle_speed"],
    rest_penetration_above: float = SETTLE_LIMITS["rest_penetration"],
) -> Findings:
    """Report a robot that moves more than these limits while it settles.

    Options:
        settle_drop_above: Metres that the robot's origin may sink from its start, including a fall
            of 0.01 m to the ground; more is an error.
        settle_rise_above: Metres that the robot's origin may rise above its start; more is an
            error.
        settle_shift_above: Metres that the robot's origin may move sideways in 2 s; more is an
            error.
        settle_tilt_above: Radians between the robot's z axis and the vertical, averaged over the
            last 0.5 s; more is an error.
        settle_speed_above: Speed of the robot's origin in m/s, averaged over the last 0.5 s; more
            is an error.
        rest_penetration_above: Metres that the deepest contact may be in the ground in the last 0.5
            s; more is an error.
    """
    if not (driven.robot.drives or context.is_subt):
        return
    if driven.robot.balances:
        yield Unchecked(NOT_RUN, Severity.WARNING)
        return
    if driven.invalid_reason:
        yield unchecked(driven.invalid_reason)
        return
    limits = {
        "settle_drop": settle_drop_above,
        "settle_rise": settle_rise_above,
        "settle_shift": settle_shift_above,
        "settle_tilt": settle_tilt_above,
        "settle_speed": settle_speed_above,
        "rest_penetration": rest_penetration_above,
    }
    symptoms = dict(excess_figures(driven.trial, limits))
    if symptoms:
        heaviest = max(driven.robot.links, key=lambda link: link.mass)
        place = heaviest.inertial.pose if heaviest.inertial is not None else heaviest
        yield finding(
            driven.robot,
            f"without a command, from 10 mm above the ground, the robot "
            f"{', '.join(symptoms.values())}",
            key=" ".join(symptoms),
            related=[(place, "the heaviest link")] if "settle_tilt" in symptoms else (),
            covered_by=("INE009",),
        )


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
