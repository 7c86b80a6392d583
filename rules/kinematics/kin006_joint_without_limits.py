"""A joint without limits that is not driven.

This includes a wheel whose opposite wheel is driven: the robot pulls to one side.

Gravity moves the part without an end. This is intended for wheels, rotors and similar parts. A
mast, a pole or a sensor mount must not move; usually it should be fixed. No accepted package that
we checked has this fault.

Fix: make the joint `type="fixed"`, or give it limits; or name it in the plugin that drives it.
Source: SDFormat specification, axis/limit: without it the range is infinite.
"""

import math
from collections.abc import Iterator

from checker.model.components import Joint, Plugin
from checker.model.locomotion.locomotion import Wheel
from checker.model.robot import Robot
from checker.model.tree import Tie
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked

_NEAR = 0.01
"""Metres by which the place and the size of a mirror image may differ."""
_TURNING = (
    *("wheel", "caster", "castor", "roller", "track", "sprocket", "idler", "pulley"),
    *("rotor", "propeller", "prop_", "blade", "fan"),
)
"""Words in the names of parts that turn freely on purpose."""


@rule("KIN006", "joint-without-limits", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, *, turning: tuple[str, ...] = _TURNING) -> Findings:
    """Report revolute and prismatic joints without limits that no plugin drives.

    Joints of parts that turn freely on purpose are skipped; in URDF they have their own type,
    `continuous`.

    Options:
        turning: Words in lower case; a joint may turn freely if its name, or that of its child
            link, contains one of them.
    """
    if not robot.conventions.states_devices:
        return
    free = [tie for tie in robot.tree.ties if _is_free(tie, robot, turning)]
    left_out = [*_left_out(robot)]
    if (free or left_out) and robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
        return
    yield from left_out
    for tie in free:
        carries = f"; it carries sensor {name!r}" if (name := _sensor(robot, tie)) else ""
        yield finding(
            tie.joint,
            f"{tie.joint.type.value} joint {tie.joint.name.value!r} has no limits, and no plugin "
            f"drives it: {tie.child!r} moves freely{carries}",
            key="carries a sensor" if carries else "free",
        )


def _left_out(robot: Robot) -> Iterator[Finding]:
    """Report wheels that turn freely while a plugin drives the one opposite."""
    for tie in robot.tree.ties:
        joint = tie.joint
        if not _is_unlimited(joint) or joint.scoped_name in robot.driven_joints:
            continue
        opposite = next((w for w in robot.locomotion.wheels if _is_opposite(robot, tie, w)), None)
        if opposite is not None and not _is_misnamed(
            robot, robot.driven_joints[opposite.joint.scoped_name]
        ):
            yield finding(
                joint,
                f"wheel joint {joint.name.value!r} is not driven, but its opposite, "
                f"{opposite.joint.name.value!r}, is driven",
                related=[(opposite.joint, "is driven")],
                key="opposite",
            )


def _is_misnamed(robot: Robot, drive: Plugin) -> bool:
    """Return whether a drive names a joint that does not exist, or one twice: it may mean this."""
    elements = drive.element.descendants()
    named = [it.text.value for it in elements if it.tag.lower().endswith("joint")]
    known = {joint.name.value for joint in robot.joints}
    return not known.issuperset(named) or len({*named}) < len(named)


def _is_opposite(robot: Robot, tie: Tie, wheel: Wheel) -> bool:
    """Return whether a wheel is the mirror image of a link: as far out, and as large."""
    pose = robot.pose_of_joint(tie.joint)
    boxes = [robot.own_box_of(link) for link in (robot.tree.links[tie.child], wheel.link)]
    sizes = [box.diagonal for box in boxes if box is not None]
    if pose is None or wheel.centre is None or len(sizes) < len(boxes):
        return False
    x, y, z = pose.translation
    mirrored = math.dist((x, -y, z), wheel.centre) < _NEAR < abs(y)
    return mirrored and abs(sizes[0] - sizes[1]) < _NEAR


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


def _wheels(mark: str, driven: str) -> str:
    wheels = "".join(
        f"""
<link name="{side}_wheel">
  <pose>0 {y} 0 0 0 0</pose>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link>
<joint name="{side}_wheel_joint" type="revolute">{mark if y < 0 else ""}
  <parent>base_link</parent><child>{side}_wheel</child><axis><xyz>0 1 0</xyz></axis>
</joint>"""
        for side, y in (("left", 0.3), ("right", -0.3))
    )
    return f"""{wheels}
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">{driven}</plugin>
"""


GOOD = [
    _wheels(
        "",
        "<left_joint>left_wheel_joint</left_joint><right_joint>right_wheel_joint</right_joint>",
    ),
    _pole("<limit><lower>-1</lower><upper>1</upper></limit>"),
    _pole("", plugin=_DRIVE),
    _pole("<limit></limit>", "left_wheel"),
]
BAD = [
    _pole(""),
    _pole("") + _SHOWS,
    _pole("").replace("<axis>", "<axis><limit><lower>-1e16</lower><upper>1e16</upper></limit>"),
    _wheels("  <!-- ^ KIN006 -->", "<left_joint>left_wheel_joint</left_joint>"),
]
