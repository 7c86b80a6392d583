"""A joint of a type that does not exist or that the target does not simulate.

Gazebo with DART turns a gearbox, a revolute2 and a continuous joint of SDF into a fixed joint: a
wheel on it does not turn. A continuous joint of URDF becomes a revolute one, and turns. Gazebo
Classic drops planar and floating joints of URDF. A robot on a floating joint of the root link
`world` is free, as it would be without the joint. Where nothing puts the robot into Gazebo, it is a
warning. No accepted package that we checked has this fault.

Fix: use `revolute` without limits for `continuous`, two joints with a light link between them for
`revolute2` and `gearbox`.
Source: `joint_types.json`: SDFormat's types, and those that the physics plugin of each release
supports.
"""

from checker.base.resources import table
from checker.base.words import Suggestions
from checker.model.robot import Robot
from checker.model.tree import WORLD
from checker.package.package import Package
from checker.rule import Concern, Context, Findings, Severity, finding, respelling, rule

_BECOMES = {
    "fixed": "which {} turns into a fixed joint",
    "dropped": "which {} drops",
}


@rule("KIN008", "joint-type-not-simulated", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot, context: Context, package: Package) -> Findings:
    """Report joint types that are unknown or not simulated by the target release."""
    known = table("joint_types")["types"][robot.conventions.joint_types]
    lost = (
        table("joint_types")["not_simulated"]
        .get(context.release, {})
        .get(robot.conventions.joint_types, {})
    )
    suggestions = Suggestions(known)
    in_gazebo = package.workspace.may_start_gazebo and not robot.shown_only
    in_gazebo = in_gazebo or context.is_gazebo_alone or context.is_subt
    for joint in robot.joints:
        # SDFormat reads the type in any case; a missing one is for SDF005.
        type = joint.type.value.lower()
        message = f"joint {joint.name.value!r} has the type {joint.type.value!r}"
        if joint.type.stated and type not in known:
            hint = suggestions.hint(type) or f"; expected one of {', '.join(known)}"
            fix = respelling(joint.type, suggestions)
            yield finding(joint.type, f"{message}, which does not exist{hint}", fix=fix)
        elif type in lost and not (type == "floating" and joint.parent.value == WORLD):
            release = f"Gazebo {context.release.capitalize()}"
            lost_in = _BECOMES[lost[type]].format(release)
            severity = None if in_gazebo else Severity.WARNING
            yield finding(joint.type, f"{message}, {lost_in}", severity=severity, key=type)


def _joint(type: str) -> str:
    return f"""
<link name="wheel"/>
<joint name="axle" type="{type}"><parent>base_link</parent><child>wheel</child></joint>
"""


def _marked(type: str) -> str:
    return _joint(type).replace("</joint>", "</joint>  <!-- ^ KIN008 -->")


_URDF = """
<link name="wheel"/>
<joint name="axle" type="continuous"><parent link="upper_arm"/><child link="wheel"/></joint>
"""
_FLOATING = """<robot name="rover">
  <link name="world"/>
  <link name="base_link"/>
  <joint name="j" type="floating"><parent link="world"/><child link="base_link"/></joint>
</robot>
"""
GOOD = [
    {"@urdf": _URDF, "@profile": "ros2"},
    {"@urdf": True, "@profile": "urdf", "urdf/arm.urdf": _FLOATING},
    _joint("revolute"),
    _joint("fixed"),
    _joint("ball"),
    _joint("Prismatic"),
]
BAD = [
    {"@fragment": _marked("continuous"), "@profile": "gazebo-harmonic"},
    _marked("continuous"),
    _marked("revolute2"),
    _marked("hinge"),
    _marked(""),
    {
        "@urdf": True,
        "@profile": "urdf",
        "urdf/arm.urdf": _FLOATING.replace('"world"', '"mast"').replace(
            "</joint>", "</joint>  <!-- ^ KIN008 -->"
        ),
    },
]
