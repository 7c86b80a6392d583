"""A joint whose position nothing publishes, beside joints that a joint_state_broadcaster publishes.

robot_state_publisher publishes the transform of a joint that moves once it knows its position. Of a
joint without a `<state_interface name="position"/>` joint_state_broadcaster publishes none: RViz
shows no transform to its links, Nav2 drops what sensors on them see, and MoveIt waits for a
complete robot state. Often this is a gripper, or a caster wheel.

It is reported where joint_state_broadcaster alone publishes what robot_state_publisher reads, and
where everything that the launch file starts is known.

Fix: add the joint with its state interface to `<ros2_control>`; a joint without a motor needs no
command interface. Or make it `fixed`.
Source: robot_state_publisher, README, `joint_states`; ros2_controllers, joint_state_broadcaster.
"""

from collections.abc import Iterator

from checker.model.components import Joint
from checker.model.controllers import Controller
from checker.model.robot import Robot
from checker.ros.ros2_control.hardware import read_hardware
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import ros2_control

_STATES = "sensor_msgs/msg/JointState"
_MANAGER = "controller_manager/ros2_control_node"
_BROADCASTER = "JointStateBroadcaster"
_CHOSEN = ("joints", "interfaces", "extra_joints", "map_interface_to_joint_state")
"""Parameters of the broadcaster that change what it publishes."""
_MOVING = ("revolute", "continuous", "prismatic")


@rule("R2C019", "joint-without-state", Severity.WARNING, Concern.ROBOT)
def check(wiring: Wiring) -> Findings:
    """Report the joints of a robot that its joint_state_broadcaster does not publish."""
    others = (node for node in wiring.every_node if node.program != _MANAGER)
    if (
        any(node.publishes_more(_STATES) for node in others)
        or wiring.unread
        or wiring.unknown_parts
    ):
        return
    for node, robot in wiring.described:
        missing = [*_without_state(robot)] if _is_broadcast(wiring, node) else []
        if missing:
            names = ", ".join(repr(joint.name.value) for joint in missing)
            first = missing[0]
            yield finding(
                first.name,
                f"nothing publishes the position of {names}, so {first.child.value!r} has no "
                f'transform: write <joint name="{first.name.value}"><state_interface '
                'name="position"/></joint> into <ros2_control>',
                key=names,
            )


def _is_broadcast(wiring: Wiring, node: WiredNode) -> bool:
    """Return whether a joint_state_broadcaster alone publishes what a state publisher reads."""
    topic = node.resolve("joint_states")
    publishers = [
        each
        for each in wiring.endpoints
        if each.publishes and each.topic == topic and {_STATES, "*"}.intersection(each.types)
    ]
    return any(each.certain for each in publishers) and all(
        isinstance(each.owner, Controller)
        and each.owner.class_name == _BROADCASTER
        and each.owner.own.isdisjoint(_CHOSEN)
        for each in publishers
    )


def _without_state(robot: Robot) -> Iterator[Joint]:
    """Yield the joints that move, and whose position no hardware states."""
    hardware = read_hardware(robot.document.root)
    if not hardware or robot.unresolved_includes:
        return
    stated = {
        joint.name.value
        for each in hardware
        for joint in each.joints
        if any(state.name.value == "position" for state in joint.states)
    }
    for joint in robot.joints:
        if joint.type.value in _MOVING and not joint.mimics and joint.name.value not in stated:
            yield joint


_LAUNCH = """<launch>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/arm.urdf')"/>
  </node>
  <node pkg="controller_manager" exec="ros2_control_node">
    <param from="$(find-pkg-share acme_rover_bringup)/config/arm.yaml"/>
  </node>
  <node pkg="controller_manager" exec="spawner" args="states"/>@
</launch>
"""
_PARAMETERS = """controller_manager:
  ros__parameters:
    states: {type: joint_state_broadcaster/JointStateBroadcaster}
"""
_FINGER = """<link name="finger"/>
<joint name="grip" type="prismatic">
  <parent link="base_link"/><child link="finger"/><axis xyz="1 0 0"/>
  <limit lower="0" upper="0.03" effort="5" velocity="0.1"/>
</joint>"""


def _arm(joints: str = "", mark: str = "", nodes: str = "", config: str = "") -> dict[str, object]:
    grip = _FINGER.replace('"prismatic">', f'"prismatic">{mark}')
    return {
        "@bridge": True,
        "launch/rover.launch.py": None,
        "launch/arm.launch.xml": _LAUNCH.replace("@", nodes),
        "config/arm.yaml": _PARAMETERS + config,
        "urdf/arm.urdf": f"""<robot name="arm">
<link name="base_link"/><link name="upper_arm"/>
<joint name="shoulder" type="continuous">
  <parent link="base_link"/><child link="upper_arm"/><axis xyz="0 0 1"/>
</joint>
{grip}{ros2_control(_SHOULDER + joints)}</robot>
""",
    }


_SHOULDER = '<joint name="shoulder"><state_interface name="position"/></joint>'
_OTHER = '\n  <node pkg="joint_state_publisher" exec="joint_state_publisher"/>'
_MARK = "  <!-- ^ R2C019 -->"
GOOD = [
    _arm(_SHOULDER.replace("shoulder", "grip")),
    _arm(nodes=_OTHER),
    _arm(config="states:\n  ros__parameters: {extra_joints: [grip]}\n"),
    _arm(nodes='\n  <node pkg="acme_hand" exec="driver"/>'),
]
BAD = [
    _arm(mark=_MARK),
    _arm('<joint name="grip"><command_interface name="position"/></joint>', _MARK),
]
