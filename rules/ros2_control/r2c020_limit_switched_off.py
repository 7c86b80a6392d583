"""A limit of a drive controller that is not applied, since its switch is off by default.

In ROS 2 Humble, the drives read `linear.x.max_velocity` only with
`linear.x.has_velocity_limits: true`; accelerations and jerks have switches of their own. Without
the switch, the robot drives as fast as it is commanded.

A switch that is stated as false is meant. In Jazzy the switches are on by default.

Fix: write the switch into the parameters of the controller.
Source: diff_drive_controller, parameter files of the branches Humble and Jazzy.
"""

from checker.ros.ros2_control.distributions import ControllerType, controller_types, distribution_of
from checker.ros.ros2_control.robot_control import ConfiguredControllers
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.rulebook.example_parts import SHOULDER, ros2_control

_BOUNDS = ("max", "min")


@rule("R2C020", "limit-switched-off", Severity.WARNING, Concern.INTERFACE)
def check(control: ConfiguredControllers, context: Context) -> Findings:
    """Report one limit of each switch that is not stated."""
    distribution = distribution_of(context)
    for controller in control.controllers:
        known = controller_types().get(controller.type.value)
        if known is None:
            continue
        limits = {_switch(name): name for name in sorted(controller.own, reverse=True)}
        for switch, name in limits.items():
            if switch not in controller.parameters and _is_off(known, switch, distribution):
                yield finding(
                    controller.parameters[name],
                    f"{name} of {controller.label} has no effect: {switch} is false by default in "
                    f"ROS 2 {distribution.title()}; write {switch}: true",
                )


def _is_off(kind: ControllerType, switch: str, distribution: str) -> bool:
    declared = kind.parameter(switch) if kind.known_in(switch, distribution) else None
    return declared is not None and declared.default_in(distribution) is False


def _switch(name: str) -> str:
    """Return the switch of a limit: `x.has_velocity_limits` of `x.max_velocity`; else empty."""
    group, _, limit = name.rpartition(".")
    bound, _, quantity = limit.partition("_")
    return f"{group}.has_{quantity}_limits" if bound in _BOUNDS and quantity else ""


def _drive(limits: str, profile: str = "gazebo-fortress") -> object:
    return {
        "@urdf": ros2_control(SHOULDER.replace("position", "velocity")),
        "@profile": profile,
        "config/arm.yaml": f"""controller_manager:
  ros__parameters:
    drive_controller: {{type: diff_drive_controller/DiffDriveController}}
drive_controller:
  ros__parameters:
    left_wheel_names: [shoulder]
    right_wheel_names: [shoulder]
    wheel_radius: 0.1
    wheel_separation: 0.5
{limits}
""",
    }


_LIMIT = "    linear.x.max_velocity: 1.5"
_MARK = "  # ^ R2C020"
GOOD = [
    _drive(_LIMIT, "gazebo-harmonic"),
    _drive(f"{_LIMIT}\n    linear.x.has_velocity_limits: true"),
    _drive(f"{_LIMIT}\n    linear.x.has_velocity_limits: false"),
    _drive("    publish_rate: 50.0"),
]
BAD = [
    _drive(_LIMIT + _MARK),
    _drive(f"{_LIMIT}{_MARK}\n    linear.x.min_velocity: -0.5"),
    _drive(f"    linear:\n      x:\n        max_acceleration: 1.0{_MARK}"),
]
