"""A joint that speed commands drive past its position limits, because it has no effort limit.

DART enforces the position limits of a joint under speed commands only if its effort is limited.
Otherwise the joint moves past them, and Gazebo prints "Velocity control does not respect positional
limits of joints if these joints do not have an effort limit". Without `<effort>`, SDF has no effort
limit. JointController commands speeds unless `<use_force_commands>` is set.

Fix: add `<effort>` with the largest force of the motor to `<limit>`.
Source: gz-physics, dartsim/src/JointFeatures.cc.
"""

import math

from checker.model.robot import Robot
from checker.rule import Concern, Context, Findings, Severity, finding, rule

_BY_SPEED = "JointController"


@rule("KIN020", "position-limit-not-enforced", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, context: Context) -> Findings:
    """Report joints with position limits and no effort limit that JointController turns."""
    if not context.is_gazebo_sim:
        return
    for name, plugin in robot.driven_joints.items():
        joint = robot.joints_by_name.get(name)
        if plugin.class_name != _BY_SPEED or joint is None or len(joint.axes) != 1:
            continue
        axis = joint.axes[0]
        forces = any(text.value in ("1", "true") for text in plugin.at("use_force_commands"))
        limited = math.isfinite(axis.upper.value - axis.lower.value)
        if limited and math.isinf(axis.effort.value) and not forces:
            yield finding(
                axis,
                f"joint {joint.name.value!r} moves past its position limits under speed "
                "commands: DART enforces them only if the joint has an <effort> limit",
                related=[(plugin, "commands its speed")],
            )


def _arm(limit: str, inside: str = "", mark: str = "", profile: str = "gazebo-harmonic") -> object:
    fragment = f"""<link name="a"/>
<link name="b"/>
<joint name="j" type="revolute"><parent>a</parent><child>b</child>
<axis>{mark}
<xyz>0 0 1</xyz><limit>{limit}</limit></axis></joint>
<plugin filename="gz-sim-joint-controller-system" name="gz::sim::systems::JointController">
<joint_name>j</joint_name>{inside}</plugin>"""
    return {"@fragment": fragment, "@profile": profile}


_LIMIT = "<lower>-1</lower><upper>1</upper>"
GOOD = [
    _arm(f"{_LIMIT}<effort>10</effort>"),
    _arm("<lower>-1e16</lower><upper>1e16</upper>"),
    _arm(_LIMIT, "<use_force_commands>true</use_force_commands>"),
    _arm(_LIMIT, profile="gazebo-classic"),
]
BAD = [_arm(_LIMIT, mark="  <!-- ^ KIN020 -->")]
