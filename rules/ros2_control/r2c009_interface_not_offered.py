"""A controller of a joint, or of an interface, that the robot's hardware does not offer.

A controller claims the interfaces of its joints when it is activated: `wheel_joint/velocity`. If a
`<ros2_control>` tag offers no such interface, activation fails and the joints do not move.

Fix: write the joint's name as in `<ros2_control>`, or add the `<command_interface>` or
`<state_interface>` that the controller needs: drives need `velocity` of wheels and `position` of
steering joints.
Source: ros2_control, ResourceManager; ros2_controllers, `command_interface_configuration` and
`state_interface_configuration` of each controller.
"""

from collections.abc import Iterator

from checker.base.words import Suggestions, listed
from checker.model.ros2_control.claims import Claim, claims_of, sensors_of
from checker.model.ros2_control.controllers import Controller
from checker.model.ros2_control.hardware import HardwareJoint
from checker.model.ros2_control.robot_control import RobotControl
from checker.rule import Concern, Finding, Findings, Severity, finding, rule


@rule("R2C009", "interface-not-offered", Severity.ERROR, Concern.INTERFACE)
def check(control: RobotControl) -> Findings:
    """Report what controllers of ros2_controllers need and do not find.

    Where no plugin of the robot names the file, it may be for another robot: a warning.
    """
    severity = None if control.is_named else Severity.WARNING
    suggestions = Suggestions(control.components)
    if control.has_variants or not control.hardware:
        return
    for controller in control.controllers:
        for claim in claims_of(controller):
            joint = control.joints.get(claim.joint.value)
            if joint is not None:
                yield from _missing(controller, claim, joint, severity)
            elif claim.joint.value not in control.components:
                yield _unknown(control, controller, claim, suggestions, severity)
        for sensor in sensors_of(controller):
            if sensor.value not in control.components:
                hint = suggestions.hint(sensor.value)
                yield finding(
                    sensor,
                    f"{controller.called} reads {sensor.value!r}, which is not a sensor or gpio of "
                    f"<ros2_control>{hint}",
                    severity=severity,
                )


def _unknown(
    control: RobotControl,
    controller: Controller,
    claim: Claim,
    suggestions: Suggestions,
    severity: Severity | None,
) -> Finding:
    name = claim.joint.value
    exists = name in control.robot.joints_by_name
    where = "is in no <ros2_control> tag" if exists else "the robot does not have"
    hint = suggestions.hint(name)
    return finding(
        claim.joint,
        f"{controller.called} names joint {name!r}, which {where}{hint}",
        severity=severity,
        key=f"{name} {controller.name}",
    )


def _missing(
    controller: Controller, claim: Claim, joint: HardwareJoint, severity: Severity | None
) -> Iterator[Finding]:
    for kind, needed, offered in (
        ("command", claim.commands, joint.commands),
        ("state", claim.states, joint.states),
    ):
        names = [interface.name.value for interface in offered]
        for name in needed:
            if name not in names:
                has = f"it offers {listed(names)}" if names else "it offers none"
                yield finding(
                    claim.joint,
                    f"{controller.called} needs the {kind} interface {name!r} of joint "
                    f"{claim.joint.value!r}, but {has}",
                    severity=severity,
                    key=f"{controller.name} {kind} {name}",
                    related=[(joint, "the joint in <ros2_control>")],
                )


def _arm(
    parameters: str, kind: str = "joint_trajectory_controller/JointTrajectoryController"
) -> object:
    return {
        "@urdf": """
<ros2_control name="arm" type="system">
  <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
  <joint name="shoulder">
    <command_interface name="position"/>
    <state_interface name="position"/>
  </joint>
  <sensor name="imu"><state_interface name="orientation.x"/></sensor>
</ros2_control>
<gazebo>
  <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
    <parameters>$(find acme_arm_description)/config/arm.yaml</parameters>
  </plugin>
</gazebo>
""",
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


_FORWARD = "forward_command_controller/ForwardCommandController"
_IMU = "imu_sensor_broadcaster/IMUSensorBroadcaster"
GOOD = [
    _follow("shoulder"),
    _follow("$(var prefix)shoulder"),
    _arm("interface_name: position\n    joints: [shoulder]", _FORWARD),
    _arm("sensor_name: imu\n    frame_id: base_link", _IMU),
]
BAD = [
    _arm("joints: [elbow]  # ^ R2C009"),
    _arm(
        "joints: [shoulder]  # ^ R2C009\n"
        "    command_interfaces: [position]\n    state_interfaces: [position, velocity]"
    ),
    _arm("interface_name: velocity\n    joints: [shoulder]  # ^ R2C009", _FORWARD),
    _arm("sensor_name: imu_sensor  # ^ R2C009\n    frame_id: base_link", _IMU),
]
