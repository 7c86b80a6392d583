"""A model that MuJoCo refuses.

If another simulator refuses a model, some part of it has no physical meaning; Gazebo guesses, and
its physics engines guess differently. The INE rules report masses and inertias.

Fix: correct the part that the message names. The result of the trial lists the repairs that the
trial needed.
Source: MuJoCo documentation, XML reference: checks of the compiler.
"""

import re

from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Concern, Findings, Severity, finding, rule

_OF_INERTIA = re.compile(r"\b(mass|moments?)\b")
"""Repairs that the rules on inertia report in more detail."""


@rule("TRI001", "refused-by-mujoco", Severity.ERROR, Concern.ROBOT)
def check(driven: RobotTrial) -> Findings:
    """Report why the model is refused, and each repair that the trial needed."""
    trial = driven.trial
    if trial.refused:
        yield finding(
            driven.part(trial.refused_part),
            f"MuJoCo refuses the model even with repairs: {trial.refused}",
            key="refused",
        )
    for repair in trial.repairs:
        if repair.serious and not _OF_INERTIA.search(repair.what):
            yield finding(
                driven.part(repair.part),
                f"MuJoCo refuses the model without a repair: {repair.part!r} {repair.what}",
            )


def _arm(axis: str) -> str:
    return f"""
<sdf version="1.6">
<model name="acme_arm_sensor_config_1">
<link name="base_link">
  <inertial><mass>5</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.4 0.4 0.1</size></box></geometry></collision>
</link>
<link name="arm">
  <pose>0 0 0.2 0 0 0</pose>
  <inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
</link>
<joint name="shoulder" type="revolute">{axis}
</joint>
</model>
</sdf>
"""


_ENDS = "<parent>base_link</parent><child>arm</child>"
_MARK = "  <!-- ^ TRI001 -->"
GOOD = [_arm(f"{_ENDS}<axis><xyz>0 0 1</xyz></axis>")]
BAD = [_arm(f"{_MARK}\n{_ENDS}<axis><xyz>0 0 0</xyz></axis>")]
