"""Interfaces that controllers claim: the joints that they name, and the interfaces of each."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from checker.base.record import Record
from checker.model.controllers import Controller
from checker.ros.ros2_control.distributions import controller_types
from checker.source.text import Located

_GROUPS: Mapping[str, str] = {
    "JointGroupPositionController": "position",
    "JointGroupVelocityController": "velocity",
    "JointGroupEffortController": "effort",
}
_NAMED_BY: Mapping[str, str] = {
    "ForwardCommandController": "interface_name",
    "MultiInterfaceForwardCommandController": "interface_names",
    "PidController": "command_interface",
}
"""Parameters that name the command interfaces."""
_GRIPPERS: Mapping[str, str] = {
    "position_controllers": "position",
    "effort_controllers": "effort",
    "parallel_gripper_action_controller": "position",
}
_OF_INTERFACES = ("max_effort_interface", "max_velocity_interface")
"""Parameters of a gripper that name command interfaces in full: `finger/effort`."""
_STEERING = ("AckermannSteering", "BicycleSteering", "TricycleSteering")
_WHEELS = ("left_wheel_names", "right_wheel_names", "wheel_names")
_CORNER = "_wheel_command_joint_name"
_STEERS = ("steering_joints_names", "steering_joint_name")
_DRIVES = ("traction_joints_names", "traction_joint_name")
_ENDS = ("front_wheels_names", "rear_wheels_names")
_LISTENED = ("extra_joints", "_state_names", "_state_joint_name", "reference_and_state_dof_names")
"""Ends of parameters whose joints are only listened to, or need not be there at all."""


class Claim(Record, eq=False):
    """A joint that a controller names, with the interfaces that it needs.

    Attributes:
        joint: The joint as the parameter names it.
        commands: Command interfaces that it needs.
        states: State interfaces that it needs.
    """

    joint: Located[str]
    commands: tuple[str, ...] = ()
    states: tuple[str, ...] = ()


def claims_of(controller: Controller) -> Iterator[Claim]:
    """Yield the joints of a controller of ros2_controllers; none of other controllers.

    A name with a slash is an interface of another controller in front of the hardware.
    """
    known = controller_types().get(controller.type.value)
    for parameter in known.joint_params if known is not None else ():
        if parameter.endswith(_LISTENED) or parameter not in controller.own:
            continue
        commands, states = _needed(controller, parameter)
        for joint in controller.parameters[parameter].texts:
            if "/" not in joint.value and joint.value:
                yield Claim(joint, commands, states)
    for interface in (it for name in _OF_INTERFACES for it in controller.texts(name)):
        joint_name, _, command = interface.value.rpartition("/")
        if known is not None and joint_name and command:
            yield Claim(Located(joint_name, interface.span), (command,))


def sensors_of(controller: Controller) -> Iterator[Located[str]]:
    """Yield the sensors and gpios that a controller of ros2_controllers names."""
    known = controller_types().get(controller.type.value)
    for parameter in known.sensor_params if known is not None else ():
        if parameter in controller.own:
            yield from (text for text in controller.parameters[parameter].texts if text.value)


_Needed = tuple[tuple[str, ...], tuple[str, ...]]


def _needed(controller: Controller, parameter: str) -> _Needed:
    """Return command and state interfaces that a controller needs of the joints of a parameter."""
    name = controller.class_name
    if name in _GROUPS:
        return (_GROUPS[name],), ()
    if name in _NAMED_BY:
        return _texts(controller, _NAMED_BY[name]), ()
    if name == "GripperActionController":
        package = controller.type.value.partition("/")[0]
        return (_GRIPPERS[package],), ("position", "velocity")
    if name == "JointTrajectoryController":
        return _trajectory(controller, parameter)
    return _wheeled(controller, parameter)


def _trajectory(controller: Controller, parameter: str) -> _Needed:
    commands = _texts(controller, "command_interfaces")
    if parameter == "command_joints":
        return commands, ()
    states = _texts(controller, "state_interfaces")
    return (() if "command_joints" in controller.parameters else commands), states


def _wheeled(controller: Controller, parameter: str) -> _Needed:
    if parameter in _WHEELS:
        rolls = controller.flag("position_feedback", default=True)
        return ("velocity",), ("position" if rolls else "velocity",)
    if parameter in _STEERS:
        return ("position",), ()
    if parameter in _DRIVES or parameter.endswith(_CORNER):
        return ("velocity",), ()
    if parameter in _ENDS and controller.class_name.startswith(_STEERING):
        front = controller.flag("front_steering", default=True)
        steers = front == parameter.startswith("front")
        return ("position" if steers else "velocity",), ()
    return (), ()


def _texts(controller: Controller, parameter: str) -> tuple[str, ...]:
    return tuple(text.value for text in controller.texts(parameter))
