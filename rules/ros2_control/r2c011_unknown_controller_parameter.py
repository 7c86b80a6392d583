"""A parameter that a controller does not know.

Parameters that a controller does not declare are ignored without a message: the value has no
effect. Usually a name is misspelt, belongs to another controller, or is of another distribution.
Since Jazzy, the drives read `TwistStamped` only: `use_stamped_vel: false` is ignored, and messages
of type `Twist` do not move the robot. A controller of a group of joints replaces `interface_name`
by the interface of its type.

A JointTrajectoryController has `constraints.<joint>.goal` and `gains.<joint>.p`: without the joint
they are unknown.

Fix: remove the parameter, or correct its name.
Source: parameter files of ros2_controllers, by branch.
"""

import re
from collections.abc import Iterable, Iterator

from checker.base.words import Suggestions
from checker.model.controllers import Controller
from checker.package.package import Package
from checker.ros.ros2_control.distributions import (
    COMMON_PARAMETERS,
    ControllerType,
    controller_types,
    distribution_of,
)
from checker.ros.ros2_control.robot_control import ConfiguredControllers
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Severity,
    finding,
    respelling,
    rule,
    unchecked,
)
from checker.rulebook.example_parts import SHOULDER, ros2_control
from checker.source.text import Located

_STAMPED = "use_stamped_vel"
_INTERFACE = "interface_name"
_READ_OTHERWISE = ("qos_overrides.", "sensor_filter_chain.", "filter", "kinematics.")
"""Starts of parameters that rclcpp, filters and solvers of kinematics declare themselves."""
_JOINT = re.compile(r"(?P<first>\w+)\.<(?P<list>joints|dof_names)>\.(?P<last>\w+)")
"""A parameter that each joint of a list has."""


@rule("R2C011", "unknown-controller-parameter", Severity.WARNING, Concern.INTERFACE)
def check(control: ConfiguredControllers, context: Context, package: Package) -> Findings:
    """Report parameters of ros2_controllers that have no effect.

    One that only other distributions know is an info, except `use_stamped_vel: false`. Controllers
    of packages in the workspace are not checked, since they may be changed copies.
    """
    distribution = distribution_of(context)
    for controller in control.controllers:
        known = controller_types().get(controller.type.value)
        if known is None:
            continue
        if package.workspace.package(known.package) is not None:
            yield unchecked(f"{controller.label} is of a package in the workspace: it may differ")
            continue
        for name in sorted(controller.own) if _known_parameters(known, distribution) else ():
            if name in COMMON_PARAMETERS or name.startswith(_READ_OTHERWISE):
                continue
            if known.interface and name == _INTERFACE:
                yield from _replaced(controller, known.interface)
            elif not known.known_in(name, distribution):
                yield _without_effect(controller, name, known, distribution)


def _known_parameters(kind: ControllerType, distribution: str) -> tuple[str, ...]:
    return tuple(name for name in kind.params if kind.known_in(name, distribution))


def _of_type(controller: Controller) -> str:
    return f"{controller.label} ({controller.type.value})"


def _replaced(controller: Controller, interface: str) -> Iterator[Finding]:
    """Report an interface that is not the one of the controller's type."""
    parameter = controller.parameters[_INTERFACE]
    if parameter.is_known and parameter.node.scalar != interface:
        yield finding(
            parameter.key,
            f"{_of_type(controller)} commands {interface}, and ignores {_INTERFACE} "
            f"{parameter.span.text}: expected {interface}",
        )


def _without_effect(
    controller: Controller, name: str, known: ControllerType, distribution: str
) -> Finding:
    parameter, of_type = controller.parameters[name], _of_type(controller)
    if known.parameter(name) is None:
        names = _known_parameters(known, distribution)
        if meant := _for_each_joint(controller, name, names):
            message = f"{of_type} has no parameter {name}: expected {meant}, one for each joint"
            return finding(parameter.key, message)
        suggestions = Suggestions(it for it in names if it not in controller.own)
        return finding(
            parameter.key,
            f"{of_type} has no parameter {name}{suggestions.hint(name)}",
            fix=respelling(Located(name, parameter.key.span), suggestions),
        )
    message = f"{name} of {of_type} has no effect in ROS 2 {distribution.title()}"
    if name != _STAMPED or parameter.node.scalar is not False:
        return finding(parameter.key, message, severity=Severity.INFO)
    message += (
        ": the controller reads TwistStamped, and Twist does not move the robot; "
        "publish geometry_msgs/msg/TwistStamped"
    )
    return finding(parameter.key, message)


def _for_each_joint(controller: Controller, name: str, names: Iterable[str]) -> str:
    """Return the parameter of a joint that is meant where the joint is left out; else nothing."""
    first, *others = name.split(".")
    for known in names:
        place = _JOINT.fullmatch(known)
        if place and place["first"] == first and place["last"] in others:
            joints = controller.parameters.get(place["list"])
            items = joints.node.items if joints is not None else ()
            joint = items[0].scalar if items else "<joint>"
            return f"{first}.{joint}.{place['last']}"
    return ""


def _controller(kind: str, *parameters: str) -> dict[str, object]:
    lines = "\n    ".join((f"type: {kind}", *parameters))
    return {
        "@urdf": ros2_control(SHOULDER.replace("position", "velocity")),
        "config/arm.yaml": f"arm_controller:\n  ros__parameters:\n    {lines}\n",
    }


def _arm(parameter: str) -> dict[str, object]:
    kind = "diff_drive_controller/DiffDriveController"
    return _controller(kind, "left_wheel_names: [shoulder]", parameter)


def _group(interface: str, mark: str = "") -> object:
    kind = "velocity_controllers/JointGroupVelocityController"
    return _controller(kind, "joints: [shoulder]", f"interface_name: {interface}{mark}")


def _trajectory(*parameters: str) -> object:
    """Return a controller of an arm, with further parameters."""
    kind = "joint_trajectory_controller/JointTrajectoryController"
    interfaces = "command_interfaces: [velocity]", "state_interfaces: [position, velocity]"
    return _controller(kind, "joints: [shoulder]", *interfaces, *parameters)


_NODE = """        Node(package='controller_manager', executable='ros2_control_node', parameters=[
            get_package_share_directory('acme_arm_bringup') + '/config/arm.yaml']),"""


def _unread_robot(parameter: str) -> object:
    """Return a launched controller of a robot that includes a package which is not available."""
    hand = '<xacro:include filename="$(find acme_hand)/hand.xacro"/><link name="${hand}"/>'
    arm = f'<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">{hand}</robot>'
    controller = _arm(parameter)
    return {**controller, "@urdf": None, "@ros2": _NODE, "urdf/arm.urdf.xacro": arm}


_MARK = "  # ^ R2C011"
GOOD = [
    _arm("linear.x.max_velocity: 1.0"),
    _arm("linear: {x: {max_velocity: 1.0}}"),
    _arm("use_sim_time: true"),
    _group("velocity"),
    _trajectory("constraints: {shoulder: {goal: 0.1}, goal_time: 1.0}"),
]
BAD = [
    _arm(f"wheel_seperation: 0.5{_MARK}"),
    _unread_robot(f"wheel_seperation: 0.5{_MARK}"),
    _arm(f"use_stamped_vel: false{_MARK}"),
    _arm(f"wheels_per_side: 1{_MARK}"),
    _arm(f"constraints: {{goal_time: 1.0}}{_MARK}"),
    _group("position", _MARK),
    _trajectory(f"constraints: {{goal: {{position: 0.1}}}}{_MARK}"),
    _trajectory(f"gains: {{p: 1.0}}{_MARK}"),
]
