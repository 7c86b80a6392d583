"""A controller that needs another interface than the transmission offers.

Controllers of `effort_controllers` need the EffortJointInterface of their joints, and so on for the
other packages. If the transmission offers another interface, or no transmission offers one, the
controller manager does not find the joint and the spawner ends with an error. A controller that no
launch file names is a warning.

Fix: state the interface that the controller needs in the transmission's `<hardwareInterface>`, or
use the controller from the package for that interface.
Source: ros_control, `controller_interface::Controller<T>::initRequest`; ros_controllers;
gazebo_ros_control, `DefaultRobotHWSim::initSim`.
"""

from collections.abc import Mapping

from checker.base.words import Suggestions
from checker.package.package import Package
from checker.ros.control.controllers import Controller, ControlSystem
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

INTERFACES: Mapping[str, str] = {
    "effort_controllers": "EffortJointInterface",
    "position_controllers": "PositionJointInterface",
    "velocity_controllers": "VelocityJointInterface",
    "diff_drive_controller": "VelocityJointInterface",
}
"""The interface that the controllers of a package need."""


@rule("CTL003", "controller-interface-mismatch", Severity.ERROR, Concern.INTERFACE)
def check(control: ControlSystem, package: Package) -> Findings:
    """Report controllers whose joints have no transmission of the interface they need."""
    if control.unread_robot:
        yield unchecked(control.unread_robot)
        return
    started = {it.name for it in (*control.spawned_controllers, *control.dormant)}
    named = package.workspace.launch_words | started
    unknown = [it.name for it in control.spawned_controllers if it.name not in control.namesakes]
    misspelt = Suggestions(unknown)
    for controller in control.configured_controllers.values():
        starts = controller.name in named or misspelt.correction(controller.name)
        yield from _mismatches(control, controller, None if starts else Severity.WARNING)


def _mismatches(
    control: ControlSystem, controller: Controller, severity: Severity | None
) -> Findings:
    needed = INTERFACES.get(controller.family)
    if needed is None or controller.type is None:
        return
    for joint in controller.joints:
        offered = control.interfaces.get(joint.value)
        if offered is None and control.moves(joint.value):
            yield finding(
                joint,
                f"controller {controller.name!r} of type {controller.type.value} needs {needed} "
                f"for joint {joint.value!r}, but no transmission offers it",
                severity=severity,
            )
        if offered is None or offered.value == needed:
            continue
        yield finding(
            controller.type,
            f"controller {controller.name!r} of type {controller.type.value} needs {needed} for "
            f"joint {joint.value!r}, but its transmission offers {offered.value}",
            severity=severity,
            key=f"{controller.full_name} {needed}",
            related=[(offered, f"the interface of joint {joint.value!r}")],
        )


def _config(kind: str) -> dict[str, object]:
    return {
        "@urdf": True,
        "config/control.yaml": f"""arm:
  shoulder_controller:
    type: {kind}
    joint: shoulder
""",
    }


_ON_THE_ACTUATOR = """
<transmission name="t">
  <type>transmission_interface/SimpleTransmission</type>
  <joint name="shoulder"/>
  <actuator name="m"><hardwareInterface>PositionJointInterface</hardwareInterface></actuator>
</transmission>
"""

_LAUNCH = """<launch>
  <rosparam file="$(find acme_arm_description)/config/control.yaml" command="load"/>
  <node name="spawner" pkg="controller_manager" type="spawner" ns="/arm" args="@"/>
</launch>
"""
GOOD = [
    {"@urdf": True},
    _config("my_controllers/Stepper"),
    {**_config("position_controllers/JointPositionController"), "@urdf": _ON_THE_ACTUATOR},
]
BAD = [
    {
        **_config("position_controllers/JointPositionController  # ^ CTL003"),
        "launch/control.launch": _LAUNCH.replace("@", "state_controller"),
    },
    _config("position_controllers/JointPositionController  # ^ CTL003"),
    _config("diff_drive_controller/DiffDriveController  # ^ CTL003"),
    {
        **_config("effort_controllers/JointPositionController  # ^ CTL003"),
        "@urdf": _ON_THE_ACTUATOR,
    },
]
