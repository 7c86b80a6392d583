"""A controller of a joint, or of an interface, that the robot's hardware does not offer.

A controller claims the interfaces of its joints when it is activated: `wheel_joint/velocity`. If a
`<ros2_control>` tag offers no such interface, activation fails and the joints do not move. For a
controller that no launch file names, this is a warning: nothing starts it. A controller that launch
files start for other robots alone, with which this one shares a file, does not count. A package
with one robot and no controllers is compared with those of the only other package that configures
its joints.

Fix: write one name of the joint in URDF, `<ros2_control>` and controller, or add the
`<command_interface>` or `<state_interface>` that the controller needs: drives need `velocity` of
wheels and `position` of steering joints.
Source: ros2_control, ResourceManager; ros2_controllers, `command_interface_configuration` and
`state_interface_configuration` of each controller.
"""

import re
from collections.abc import Iterator

from msgspec.structs import replace

from checker.base.words import Suggestions, and_list
from checker.finding import Fix
from checker.model.controllers import Controller
from checker.package.package import Package
from checker.ros.ros2_control.claims import Claim, claims_of, sensors_of
from checker.ros.ros2_control.distributions import is_mock, is_of_gazebo
from checker.ros.ros2_control.hardware import WITH_PID, HardwareJoint
from checker.ros.ros2_control.robot_control import RobotControl
from checker.ros.spawned_files import SpawnedFiles
from checker.rule import (
    Concern,
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    misspelt,
    rule,
)
from checker.rulebook.example_parts import GAZEBO, gazebo_control, ros2_control
from checker.source.xml_insertion import append_to

_PLACEHOLDER = re.compile(r"<\w+>")
"""What a launch file replaces: `<namespace>/imu`, with nav2_common's ReplaceString."""


@rule("R2C009", "unavailable-interface", Severity.ERROR, Concern.INTERFACE)
def check(control: RobotControl, package: Package, spawned: SpawnedFiles) -> Findings:
    """Report what controllers of ros2_controllers need and do not find.

    Where no plugin of the robot names the file, it may be for another robot: a warning. So is what
    no launch file of any available package starts.
    """
    if control.has_variants or not control.hardware:
        return
    suggestions = Suggestions(control.components)
    for controller in control.controllers or control.beside:
        for fault in _faults(control, controller, suggestions):
            if spawned.starts_for_others(control.robot, controller.name):
                break
            if not control.is_named:
                yield replace(fault, severity=Severity.WARNING)
            elif controller.name not in package.workspace.launch_words:
                message = f"{fault.message} (no launch file starts this controller)"
                yield replace(fault, severity=Severity.WARNING, message=message)
            else:
                yield fault


def _faults(
    control: RobotControl, controller: Controller, suggestions: Suggestions
) -> Iterator[Finding]:
    for claim in claims_of(controller):
        name = claim.joint.value
        joint = control.joints.get(name)
        if joint is not None:
            yield from _missing(control, controller, claim, joint)
        elif name not in control.components and not control.may_be_included(claim.joint):
            message = f"{controller.label} names joint {name!r}, which"
            key = f"{name} {controller.name}"
            if name in control.robot.joints_by_name:
                message += " is in no <ros2_control> tag"
                meant = _meant(control, name)
                if meant is not None:
                    message += f": write {name!r} there for {meant.name.value!r}"
                related = [(meant, "the joint in <ros2_control>")] if meant is not None else []
                yield finding(claim.joint, message, key=key, related=related)
            else:
                message += " the robot does not have"
                yield misspelt(claim.joint, message, suggestions, key=key)
    for sensor in sensors_of(controller):
        if sensor.value not in control.components and not _PLACEHOLDER.search(sensor.value):
            yield misspelt(
                sensor,
                f"{controller.label} reads {sensor.value!r}, which is not a sensor or gpio of "
                "<ros2_control>",
                suggestions,
            )


def _meant(control: RobotControl, name: str) -> HardwareJoint | None:
    """Return the joint of `<ros2_control>` that the robot lacks and whose name is near."""
    strays = {it.name.value: it for it in control.joints.values() if control.joint(it) is None}
    near = Suggestions(strays).closest(name)
    return strays.get(near) if near else None


def _missing(
    control: RobotControl, controller: Controller, claim: Claim, joint: HardwareJoint
) -> Iterator[Finding]:
    for kind, needed, offered in (
        ("command", claim.commands, joint.commands),
        ("state", claim.states, joint.states),
    ):
        own = (interface.name.value for interface in offered)
        names = [WITH_PID.get(name, name) for name in own]
        for name in needed:
            if name not in names:
                has = f"it offers {and_list(names)}" if names else "it offers none"
                yield finding(
                    claim.joint,
                    f"{controller.label} needs the {kind} interface {name!r} of joint "
                    f"{claim.joint.value!r}, but {has}",
                    key=f"{controller.name} {kind} {name}",
                    related=[(joint, "the joint in <ros2_control>")],
                    fix=_added(control, joint, f'<{kind}_interface name="{name}"/>'),
                )


def _added(control: RobotControl, joint: HardwareJoint, line: str) -> Fix | None:
    """Return the fix that adds an interface; None for hardware that may not offer it."""
    plugins = (it.plugin.value for it in control.hardware if joint in it.joints)
    if not all(is_of_gazebo(plugin) or is_mock(plugin) for plugin in plugins):
        return None
    return Fix(Safety.UNSAFE, (append_to(joint.element, [line]),))


_INTERFACES = """<joint name="shoulder">
    <command_interface name="position"/>
    <state_interface name="position"/>
  </joint>
  <sensor name="imu"><state_interface name="orientation.x"/></sensor>"""
_PARAMETERS = "<parameters>$(find acme_arm_description)/config/arm.yaml</parameters>"


def _arm(
    parameters: str,
    kind: str = "joint_trajectory_controller/JointTrajectoryController",
    more: str = "",
) -> dict[str, object]:
    return {
        "@urdf": ros2_control(_INTERFACES + more, GAZEBO) + gazebo_control(_PARAMETERS),
        "config/arm.yaml": f"""controller_manager:
  ros__parameters:
    arm_controller:
      type: {kind}
arm_controller:
  ros__parameters:
    {parameters}
""",
    }


def _follow(joint: str, state: str = "position") -> object:
    return _arm(
        f"joints: [{joint}]\n    command_interfaces: [position]\n    state_interfaces: [{state}]"
    )


def _beside(joints: str) -> dict[str, object]:
    """Return a robot whose controllers another package configures."""
    bringup = "../acme_arm_bringup"
    arm = _arm(f"joints: {joints}")
    return {
        "@urdf": ros2_control(_INTERFACES),
        f"{bringup}/package.xml": "<package><name>acme_arm_bringup</name></package>",
        f"{bringup}/config/arm.yaml": arm["config/arm.yaml"],
    }


_FORWARD = "forward_command_controller/ForwardCommandController"
_GRIPPER = "parallel_gripper_action_controller/GripperActionController"
_IMU = "imu_sensor_broadcaster/IMUSensorBroadcaster"
_HELD = _arm("interface_name: position\n    joints: [shoulder]", _FORWARD)
GOOD = [
    _follow("shoulder"),
    _follow("$(var prefix)shoulder"),
    _arm("interface_name: position\n    joints: [shoulder]", _FORWARD),
    _arm("sensor_name: imu\n    frame_id: base_link", _IMU),
    _arm("sensor_name: <robot>/imu\n    frame_id: base_link", _IMU),
    _beside("[shoulder]"),
    {**_HELD, "@urdf": str(_HELD["@urdf"]).replace('"position"', '"position_pid"', 1)},
]
BAD = [
    _arm("joints: [elbow]  # ^ R2C009"),
    {**_beside("[shoulder, elbow]"), "@reported": ["../acme_arm_bringup/config/arm.yaml:7"]},
    _arm("joints: [elbow]  # ^ R2C009", more='<joint name="elbow_"/>'),
    _arm(
        "joints: [shoulder]  # ^ R2C009\n"
        "    command_interfaces: [position]\n    state_interfaces: [position, velocity]"
    ),
    _arm("interface_name: velocity\n    joints: [shoulder]  # ^ R2C009", _FORWARD),
    _arm("max_effort_interface: shoulder/effort  # ^ R2C009", _GRIPPER),
    _arm("sensor_name: imu_sensor  # ^ R2C009\n    frame_id: base_link", _IMU),
]
