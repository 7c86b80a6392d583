"""A robot that gains energy while nothing drives it.

Energy comes from nowhere in the simulation only: a joint starts beyond its limits and is pushed
back, a part starts inside the ground, or a loop of stiff parts fights itself. The robot twitches,
jumps or creeps.

Fix: let every joint start within its limits, and look at what starts inside something else.
Source: kinetic and potential energy at rest, in shares of the energy that lifts the robot by 0.1 m.
"""

from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Findings, Severity, finding, rule


@rule("TRI017", "gains-energy", Severity.WARNING)
def check(driven: RobotTrial, *, warning_above: float = 0.1) -> Findings:
    """Report a gain of energy while nothing drives the robot.

    Options:
        warning_above: Energy gained, as a share of what lifts the robot by 0.1 m; more is reported
            (0.1 stands for a lift of 10 mm).
    """
    gain = driven.trial.value("energy_gain")
    if gain is not None and gain > warning_above:
        yield finding(
            driven.robot,
            f"left alone, it gains as much energy as lifts it by {gain * 0.1:.2g} m, expected at "
            f"most {warning_above * 0.1:g} m",
            key="energy_gain",
        )


def _arm(lower: float, mark: str = "") -> dict[str, object]:
    added = f"""
<link name="arm">
  <pose>0.3 0 0.4 0 0 0</pose>
  <inertial><mass>2</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
</link>
<joint name="hinge" type="revolute">
  <pose>-0.3 0 0 0 0 0</pose>
  <parent>base_link</parent><child>arm</child>
  <axis><xyz>0 -1 0</xyz><limit><lower>{lower}</lower><upper>1.5</upper></limit></axis>
</joint>
</model>"""
    return {
        "@robot": "rover",
        "@change": {'sensor_config_1">': f'sensor_config_1">{mark}', "</model>": added},
    }


GOOD = [_arm(-0.5)]
BAD = [_arm(0.5, "  <!-- ^ TRI017 -->")]
