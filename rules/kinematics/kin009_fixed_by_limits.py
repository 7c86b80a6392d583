"""A joint that cannot move: its two limits are equal, or it is fixed while a plugin drives it.

The physics engine holds the joint by force in every step, which costs time and yields under load; a
fixed joint costs nothing. If the joint carries a sensor and is not driven, this is a warning: the
frame of its data moves slightly. If a plugin drives the joint, this is an error: a wheel that does
not turn is dragged along. In URDF, a joint written as fixed is a warning: Gazebo merges its links,
and the plugin finds no joint.

A driven wheel whose limits end after a few turns also stops there, and so does the robot. Limits of
a continuous joint of URDF stop nothing: its readers ignore them (URD029).

Fix: write `type="fixed"` and remove the axis with its limits; Gazebo keeps the sensors of the link
and its frame, and the link itself if `<gazebo reference="…">` of the joint says
`<preserveFixedJoint>true`. A joint that a plugin moves is `revolute`, with different limits or
none.
Source: SDFormat specification, joint/type.
"""

from collections.abc import Iterator

from checker.model.components import Joint
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule


@rule("KIN009", "fixed-by-limits", Severity.INFO, Concern.ROBOT)
def check(robot: Robot, *, range_of_a_wheel: float = 1000.0) -> Findings:
    """Report joints that cannot move, and driven wheels that stop: errors if a plugin drives them.

    A joint that carries a sensor, and that ros2_control does not know, is a warning.

    Options:
        range_of_a_wheel: Radians; a driven wheel between limits that are closer is reported.
    """
    for joint in robot.joints:
        why = joint.immovable
        plugin = robot.driven_joints.get(joint.scoped_name)
        if not why or (plugin is None and joint.type.value == "fixed"):
            continue
        message = f"{joint.type.value} joint {joint.name.value!r} cannot move: {why}"
        if plugin is None:
            yield _undriven(robot, joint, message)
            continue
        yield finding(
            joint,
            f"{message}, but {plugin.class_name} drives it",
            severity=Severity.WARNING if _is_merged(robot, joint) else Severity.ERROR,
            related=[(plugin, "drives it")],
            key="driven",
        )
    yield from _stopped_wheels(robot, range_of_a_wheel)


def _undriven(robot: Robot, joint: Joint, message: str) -> Finding:
    bodies = robot.tree.rigid_bodies
    body = bodies.of_link.get(joint.scope + joint.child.value, "")
    carried = (robot.links_by_name[name] for name in bodies.links.get(body, ()))
    sensor = next((sensor for link in carried for sensor in link.sensors), None)
    controls = robot.element.all("ros2_control")
    names = {it.get("name") for control in controls for it in control.all("joint")}
    if sensor is None or joint.name.value in names:
        return finding(joint, message, key="equal limits")
    return finding(
        joint,
        f'{message}, and carries sensor {sensor.name.value!r}: expected type="fixed"',
        severity=Severity.WARNING,
        related=[(sensor, "this sensor")],
        key="equal limits of a sensor",
    )


def _stopped_wheels(robot: Robot, least: float) -> Iterator[Finding]:
    """Report wheels that a plugin drives, and that limits stop."""
    for wheel in robot.locomotion.wheels:
        axis = wheel.joint.axes[0] if wheel.joint.axes else None
        if axis is None or wheel.joint.immovable or not axis.upper.value - axis.lower.value < least:
            continue
        yield finding(
            axis.lower if axis.lower.stated else axis.upper,
            f"wheel joint {wheel.joint.name.value!r} turns only from {axis.lower.value:g} to "
            f"{axis.upper.value:g} rad: its drive stops there",
            severity=Severity.ERROR,
            key="stopped",
        )


def _is_merged(robot: Robot, joint: Joint) -> bool:
    """Return whether a joint is one that Gazebo removes: its part is fixed, as its author wrote."""
    return robot.conventions.merges_fixed_links and joint.type.value == "fixed"


def _hinge(limits: str, mark: str = "", kind: str = "revolute") -> str:
    return f"""
<link name="mast"/>
<joint name="mast_joint" type="{kind}">{mark}
  <parent>base_link</parent>
  <child>mast</child>
  <axis><xyz>0 0 1</xyz><limit>{limits}</limit></axis>
</joint>
"""


_DRIVE = """
<plugin filename="libp.so" name="ignition::gazebo::systems::JointPositionController">
  <joint_name>mast_joint</joint_name>
</plugin>
"""
_WHEELS = """
<plugin filename="libd.so" name="ignition::gazebo::systems::DiffDrive">
  <left_joint>mast_joint</left_joint>
</plugin>
"""


def _rolling(kind: str, mark: str = "") -> dict[str, str]:
    return {
        "@urdf": f"""
<link name="roller"/>
<joint name="roller_joint" type="{kind}">
  <parent link="upper_arm"/><child link="roller"/>
  <axis xyz="0 1 0"/>
  <limit lower="-3" upper="3" effort="9" velocity="9"/>{mark}
</joint>
<gazebo>
  <plugin filename="libd.so" name="gz::sim::systems::DiffDrive">
    <left_joint>roller_joint</left_joint>
  </plugin>
</gazebo>
"""
    }


_MARK = "  <!-- ^ KIN009 -->"
GOOD = [
    _rolling("continuous"),
    _hinge("<lower>-0.1</lower><upper>0.1</upper>"),
    _hinge("<lower>0</lower><upper>0</upper>", kind="fixed"),
    _hinge("<lower>-1</lower><upper>1</upper>") + _DRIVE,
    _hinge("<lower>-1e16</lower><upper>1e16</upper>") + _WHEELS,
    _hinge(""),
    # What a plugin that nobody knows does with a fixed joint is not known either.
    _hinge("", kind="fixed")
    + "<plugin filename='libeye.so' name='eye'><eyeJoint>mast_joint</eyeJoint></plugin>",
]
BAD = [
    {
        "@urdf": """
<link name="gps"/>
<link name="antenna"/>
<joint name="gps_joint" type="revolute">  <!-- ^ KIN009 -->
  <parent link="upper_arm"/><child link="gps"/>
  <axis xyz="0 0 1"/>
  <limit lower="0" upper="0" effort="1000" velocity="0"/>
</joint>
<joint name="antenna_joint" type="fixed">
  <parent link="gps"/><child link="antenna"/>
</joint>
<gazebo reference="antenna"><sensor name="gps" type="navsat"/></gazebo>
"""
    },
    _hinge("<lower>0</lower><upper>0</upper>", _MARK),
    _hinge("<lower>0.2</lower><upper>0.2</upper>", _MARK, "prismatic"),
    _hinge("<lower>0</lower><upper>0</upper>", _MARK) + _DRIVE,
    _hinge("", _MARK, "fixed") + _DRIVE,
    _hinge(f"<lower>-1</lower>{_MARK}<upper>1</upper>") + _WHEELS,
    _rolling("revolute", _MARK),
]
