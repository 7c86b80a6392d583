"""Parts that pass through each other when a joint moves through its range.

The real arm hits its own robot. Gazebo lets the parts pass, so a plan that works in the simulation
breaks the machine. For a wheel that steers this is a warning. Legs and arms may meet at the ends of
their ranges, which no gait or plan reaches: this is an info. Where a joint between the parts turns
without an end because its limits are ignored, URD029 reports that alone.

Fix: narrow the joint's limits, or shrink the collisions.
Source: a collision query in steps through the range of each joint, one at a time.
"""

from collections.abc import Iterator

from checker.formats.urdf.ignored_limits import ignored_limits
from checker.model.robot import Robot
from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("TRI015", "self-collision", Severity.WARNING, Concern.ROBOT, judges=("sweep_overlap",))
def check(driven: RobotTrial, *, warning_above: float = 0.01) -> Findings:
    """Report parts that overlap when a joint moves through its range.

    Options:
        warning_above: Metres that two parts may overlap; less than 0.001 m is never measured.
    """
    unswept = driven.trial.value("unswept_joints")
    if unswept:
        yield unchecked(
            f"{unswept:g} joints with too many shapes were not moved through their range"
        )
    wheels = {link.scoped_name for wheel in driven.robot.locomotion.wheels for link in wheel.body}
    for overlap in driven.trial.all("sweep_overlap"):
        if _turns_too_far(driven.robot, overlap.part, overlap.other):
            continue
        if overlap.value > warning_above:
            yield finding(
                driven.part(overlap.part),
                f"{overlap.part!r} and {overlap.other!r} overlap by {overlap.value * 1000:.0f} mm "
                "when their joints move through their ranges",
                severity=None if {overlap.part, overlap.other} & wheels else Severity.INFO,
                key="sweep_overlap",
                related=[(driven.part(overlap.other), f"{overlap.other!r}")],
            )


def _turns_too_far(robot: Robot, part: str, other: str) -> bool:
    """Return whether a joint between two links ignores its limits."""
    between = {*_joints_above(robot, part)} ^ {*_joints_above(robot, other)}
    return any(ignored_limits(robot.joints_by_name[name]) for name in between)


def _joints_above(robot: Robot, link: str) -> Iterator[str]:
    """Yield the names of the joints from a link up to the base."""
    seen = set[str]()
    while link not in seen and (ties := robot.tree.ties_above.get(link)):
        seen.add(link)
        yield ties[0].joint.scoped_name
        link = ties[0].parent


def _arm(upper: float, mark: str = "") -> str:
    return f"""
<sdf version="1.6">
<model name="acme_arm_sensor_config_1">
<link name="base_link">
  <inertial><mass>20</mass><inertia><ixx>0.5</ixx><iyy>0.5</iyy><izz>0.5</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.6 0.6 0.2</size></box></geometry></collision>
</link>
<link name="post">
  <pose>0 0 0.4 0 0 0</pose>
  <inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
</link>
<link name="arm">{mark}
  <pose>0.2 0 0.4 0 0 0</pose>
  <inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.5 0.05 0.05</size></box></geometry></collision>
</link>
<joint name="turn" type="revolute">
  <parent>base_link</parent><child>post</child>
  <axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis>
</joint>
<joint name="shoulder" type="revolute">
  <pose>-0.2 0 0 0 0 0</pose>
  <parent>post</parent><child>arm</child>
  <axis><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>{upper}</upper></limit></axis>
</joint>
</model>
</sdf>
"""


_LINK = """<link name="@"><inertial><mass value="5"/>
<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="# 0 0"/><geometry><box size="%"/></geometry></collision></link>"""
_BASE = _LINK.replace("@", "base").replace("#", "0").replace("%", "0.6 0.6 0.2")
_POST = _LINK[: _LINK.index("<collision>")].replace("@", "post") + "</link>"
_FOREARM = _LINK.replace("@", "forearm").replace("#", "0.2").replace("%", "0.5 0.05 0.05")
_MAST = """<joint name="mast" type="revolute"><parent link="base"/><child link="post"/>
<origin xyz="0 0 0.4"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="9" velocity="1"/>
</joint>"""


def _turning(limits: str, mark: str = "") -> dict[str, object]:
    """Return a robot whose arm turns without an end, whatever its limits."""
    base = _BASE.replace("\n", f"{mark}\n", 1)
    elbow = f"""<joint name="elbow" type="continuous"><parent link="post"/><child link="forearm"/>
<axis xyz="0 1 0"/><limit effort="9" velocity="1"{limits}/></joint>"""
    parts = "\n".join((base, _POST, _FOREARM, _MAST, elbow))
    return {"@urdf": True, "urdf/arm.urdf.xacro": f'<robot name="arm">\n{parts}\n</robot>\n'}


GOOD = [_arm(0.1), _turning(' lower="-1" upper="0.1"')]
BAD = [_arm(1.5, "  <!-- ^ TRI015 -->"), _turning("", "  <!-- ^ TRI015 -->")]
