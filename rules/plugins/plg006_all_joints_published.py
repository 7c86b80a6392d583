"""A JointStatePublisher that publishes every wheel or rotor.

Without joint names the plugin publishes all joints of the robot at the rate of the simulation. The
wheels and rotors turn all the time, their angles are not needed, and the bridge sends them to ROS.

Fix: list the joints that move sensors or arms in `<joint_name>`, or remove the plugin.
Source: SubT review findings; joint-state-publisher system of Gazebo.
"""

from collections.abc import Collection, Iterator

from checker.model.components import Joint
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_MOVING = ("revolute", "continuous", "revolute2", "universal", "ball")


@rule("PLG006", "all-joints-published", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot) -> Findings:
    """Report publishers without joint names on a robot with wheels or rotors."""
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    rotors = {rotor.joint for rotor in robot.locomotion.rotors if rotor.joint is not None}
    wheels = [joint for joint in _wheel_joints(robot) if joint not in rotors]
    turning = " and ".join(_count_phrase(wheels, "wheels") + _count_phrase(rotors, "rotors"))
    for plugin in robot.all_plugins:
        if plugin.class_name != "JointStatePublisher" or not turning:
            continue
        if plugin.element.child("joint_name") is None:
            yield finding(
                plugin,
                f"JointStatePublisher names no joints, so it publishes all {len(robot.joints)}, "
                f"{turning}",
            )


def _count_phrase(joints: Collection[Joint], name: str) -> list[str]:
    return [f"{len(joints)} of them {name}"] if joints else []


def _wheel_joints(robot: Robot) -> Iterator[Joint]:
    wheels = {link.scoped_name for link in robot.wheels}
    for joint in robot.joints:
        if joint.type.value in _MOVING and joint.scope + joint.child.value in wheels:
            yield joint


def _robot(child: str, plugin: str) -> str:
    return f"""
<link name="{child}"/>
<joint name="turns" type="revolute"><parent>base_link</parent><child>{child}</child></joint>
{plugin}
"""


_CLASS = 'name="ignition::gazebo::systems::JointStatePublisher"'
_FILE = 'filename="libignition-gazebo-joint-state-publisher-system.so"'

_MOTOR = """<plugin filename="libm.so" name="ignition::gazebo::systems::MulticopterMotorModel">
  <jointName>turns</jointName><linkName>blade</linkName>
</plugin>"""

GOOD = [
    _robot("wheel", f"<plugin {_FILE} {_CLASS}><joint_name>lift</joint_name></plugin>"),
    _robot("leg", f"<plugin {_FILE} {_CLASS}/>"),
    _robot("blade", f"<plugin {_FILE} {_CLASS}><joint_name>tilt</joint_name></plugin>{_MOTOR}"),
]
BAD = [
    _robot("front_wheel", f"<plugin {_FILE} {_CLASS}/>  <!-- ^ PLG006 -->"),
    _robot("blade", f"<plugin {_FILE} {_CLASS}/>  <!-- ^ PLG006 -->{_MOTOR}"),
]
