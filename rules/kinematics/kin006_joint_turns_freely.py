"""A joint without limits that nothing drives.

Gravity swings or slides the part without end. This is right for wheels, rotors and similar parts. A
mast, a pole or a sensor mount must not move; usually it should be fixed. None of the accepted
packages that we checked shows this.

Fix: make the joint `type="fixed"`, or give it limits; or name it in the plugin that drives it.
Source: SDFormat specification, axis/limit: without it the range is infinite.
"""

import math

from checker.model.components import Joint
from checker.model.robot import Robot
from checker.model.tree import Tie
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_TURNING = (
    *("wheel", "caster", "castor", "roller", "track", "sprocket", "idler", "pulley"),
    *("rotor", "propeller", "prop_", "blade", "fan"),
)
"""Words in the names of parts that turn freely on purpose."""


@rule("KIN006", "joint-turns-freely", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, *, turning: tuple[str, ...] = _TURNING) -> Findings:
    """Report revolute and prismatic joints without limits that no plugin drives.

    Joints of parts that turn freely on purpose are skipped; in URDF they have their own type,
    `continuous`.

    Options:
        turning: Words in lower case; a joint may turn freely if its name, or that of its child
            link, contains one of them.
    """
    if robot.format == "urdf":
        return
    free = [tie for tie in robot.tree.ties if _is_free(tie, robot, turning)]
    if free and robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
        return
    for tie in free:
        carries = f"; it carries sensor {name!r}" if (name := _sensor(robot, tie)) else ""
        yield finding(
            tie.joint,
            f"{tie.joint.type.value} joint {tie.joint.name.value!r} has no limits, and no plugin "
            f"drives it: {tie.child!r} moves freely{carries}",
            key="carries a sensor" if carries else "free",
        )


def _is_free(tie: Tie, robot: Robot, turning: tuple[str, ...]) -> bool:
    joint = tie.joint
    if not _is_unlimited(joint) or joint.scoped_name in robot.driven_joints:
        return False
    link = robot.tree.links[tie.child]
    names = f"{joint.name.value} {link.name.value}".lower()
    return tie.parent != tie.child and not any(word in names for word in turning)


def _is_unlimited(joint: Joint) -> bool:
    if joint.type.value not in ("revolute", "prismatic") or not joint.axes:
        return False
    axis = joint.axes[0]
    return math.isinf(axis.lower.value) and math.isinf(axis.upper.value)


def _sensor(robot: Robot, tie: Tie) -> str:
    sensors = robot.tree.links[tie.child].sensors
    return sensors[0].name.value if sensors else ""


def _pole(limit: str, name: str = "pole", plugin: str = "") -> str:
    return f"""
<link name="{name}"/>
<joint name="{name}_joint" type="revolute">{"" if limit or plugin else _MARK}
  <parent>base_link</parent>
  <child>{name}</child>
  <axis><xyz>0 0 1</xyz>{limit}</axis>
</joint>
{plugin}
"""


_MARK = "  <!-- ^ KIN006 -->"
_DRIVE = """
<plugin filename="libignition-gazebo-joint-controller-system.so"
        name="ignition::gazebo::systems::JointController"><joint_name>pole_joint</joint_name></plugin>
"""
_SHOWS = """
<plugin filename="libignition-gazebo-joint-state-publisher-system.so"
        name="ignition::gazebo::systems::JointStatePublisher">
  <joint_name>pole_joint</joint_name></plugin>
"""
GOOD = [
    _pole("<limit><lower>-1</lower><upper>1</upper></limit>"),
    _pole("", plugin=_DRIVE),
    _pole("<limit></limit>", "left_wheel"),
]
BAD = [
    _pole(""),
    _pole("") + _SHOWS,
    _pole("").replace("<axis>", "<axis><limit><lower>-1e16</lower><upper>1e16</upper></limit>"),
]
