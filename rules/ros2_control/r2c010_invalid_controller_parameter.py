"""A required parameter of a controller is missing, or a parameter has the wrong type.

A controller is not configured if a parameter without a default is missing, or if its wheel radius
or wheel separation is 0. ROS does not convert the types of parameters: where a `double` is
declared, `10` is an error and `10.0` is right.

With `velocity` or `effort` as its only command interface, a `JointTrajectoryController` calculates
commands by a PID whose gains are 0 by default: it starts, and no joint follows its trajectory.

Fix: add the parameter to the controller's own block below `ros__parameters`, with a decimal point
where it is a `double`; for joints without gains, a `p` that suits the robot.
Source: parameter files of ros2_controllers, by branch; joint_trajectory_controller, `gains` in
"Details about parameters"; rclcpp, `InvalidParameterTypeException`.
"""

from collections.abc import Iterator, Mapping

from checker.base.words import Suggestions, and_list
from checker.model.controllers import Controller
from checker.model.ros_parameters import Parameter
from checker.package.package import Package
from checker.ros.ros2_control.distributions import (
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
    replace_text,
    rule,
    unchecked,
)
from checker.rulebook.example_parts import SHOULDER, ros2_control

_OF_ALL: Mapping[str, str] = {"update_rate": "int", "use_sim_time": "bool", "is_async": "bool"}


@rule("R2C010", "invalid-controller-parameter", Severity.ERROR, Concern.INTERFACE)
def check(control: ConfiguredControllers, context: Context, package: Package) -> Findings:
    """Report what keeps controllers of ros2_controllers from being configured.

    A controller without any block may get its parameters from the spawner: it is a warning, and so
    are gains of a controller that no launch file starts. A controller whose package is in the
    workspace is not checked, since it may be a changed copy.
    """
    distribution = distribution_of(context)
    for file in control.files:
        for block in file.managers:
            rate = block.parameters.get("update_rate")
            if rate is not None:
                yield from _mistyped(rate, "int", "the controller manager")
    blocks = Suggestions(
        block.node for file in control.files for block in file.blocks if block not in file.managers
    )
    for controller in control.controllers:
        known = controller_types().get(controller.type.value)
        if known is None or not known.exists_in(distribution):
            continue
        if package.workspace.package(known.package) is not None:
            yield unchecked(f"{controller.label} is of a package in the workspace: it may differ")
            continue
        yield from _missing(controller, known, distribution, blocks)
        yield from _gains(controller, package)
        for name in sorted(controller.own):
            declared = known.parameter(name)
            kind = declared.type if declared and known.known_in(name, distribution) else ""
            kind = kind or _OF_ALL.get(name, "")
            yield from _mistyped(controller.parameters[name], kind, controller.label)


def _missing(
    controller: Controller, known: ControllerType, distribution: str, blocks: Suggestions
) -> Iterator[Finding]:
    wanting = known.lacking(controller.parameters, distribution)
    if not wanting:
        return
    own = controller.block is not None
    names = and_list(wanting)
    lacks = (
        f"has no {names}, so it is not configured" if own else f"has no block, but needs {names}"
    )
    yield finding(
        controller.span,
        f"{controller.label} {lacks}{'' if own else blocks.hint(controller.name)}",
        severity=None if own else Severity.WARNING,
        covered_by=("R2C013",),
    )


def _gains(controller: Controller, package: Package) -> Iterator[Finding]:
    """Report joints that a JointTrajectoryController never moves, since its PID has no gain."""
    for joint in controller.joints_without_gains:
        name, interface = joint.value, controller.texts("command_interfaces")[0]
        or_else = ", or ff_velocity_scale: 1.0" if interface.value == "velocity" else ""
        started = controller.name in package.workspace.launch_words
        yield finding(
            joint,
            f"gains of joint {name!r} of {controller.label} are all 0, so it commands "
            f"{interface.value} 0 and the joint does not follow: write "
            f"gains: {{{name}: {{p: …}}}}{or_else}",
            severity=None if started else Severity.WARNING,
            key=f"gains of {controller.name}",
        )


def _mistyped(parameter: Parameter, kind: str, owner: str) -> Iterator[Finding]:
    found = parameter.type
    if not kind or not found or found == kind or not parameter.is_known:
        return
    number = found == "int" and kind == "double"
    fix = replace_text(parameter, f"{parameter.span.text}.0") if number else None
    written = parameter.span.text if len(parameter.span.text) <= 40 else "…"
    yield finding(
        parameter,
        f"{parameter.name} of {owner} is {written}, of type {found}, expected {kind}"
        + (f": write {written}.0" if number else ""),
        fix=fix,
    )


def _arm(parameters: str, manager: str = "update_rate: 100") -> object:
    return {
        "@urdf": ros2_control(SHOULDER.replace("position", "velocity")),
        "config/arm.yaml": f"""controller_manager:
  ros__parameters:
    {manager}
    drive_controller: {{type: diff_drive_controller/DiffDriveController}}
drive_controller:{parameters}
""",
    }


_JOINTS = "    left_wheel_names: [shoulder]\n    right_wheel_names: [shoulder]\n"
_SIZES = "    wheel_radius: 0.1\n    wheel_separation: 0.5\n"
_BLOCK = "\n  ros__parameters:\n"
_MARK = "  # ^ R2C010"
_MANAGER = """        Node(package='controller_manager', executable='ros2_control_node',
             parameters=[in_package('config', 'arm.yaml')])"""


def _trajectories(parameters: str, interface: str = "velocity") -> object:
    return {
        "@urdf": ros2_control(SHOULDER.replace("position", interface)),
        "config/arm.yaml": f"""controller_manager:
  ros__parameters:
    arm: {{type: joint_trajectory_controller/JointTrajectoryController}}
arm:
  ros__parameters:
    command_interfaces: [{interface}]
    state_interfaces: [position, velocity]
    {parameters}
""",
    }


GOOD = [
    _arm(_BLOCK + _JOINTS + _SIZES),
    _arm(_BLOCK + _JOINTS + _SIZES + "    cmd_vel_timeout: 5e-1\n    open_loop: true"),
    _trajectories("joints: [shoulder]", "position"),
    _trajectories("joints: [shoulder]\n    gains: {shoulder: {p: 2.0}}", "effort"),
    _trajectories("joints: [shoulder]\n    gains: {shoulder: {ff_velocity_scale: 1.0}}"),
    _trajectories("joints: [shoulder]\n    open_loop_control: true"),
    _arm(_BLOCK + _JOINTS + _SIZES + "    pose_covariance_diagonal: [0.0, 0.1, 1.0]"),
]
BAD = [
    {
        "@urdf": ros2_control(SHOULDER),
        "config/arm.yaml": f"""controller_manager:
  ros__parameters:
    grip: {{type: position_controllers/GripperActionController}}
grip:{_MARK}
  ros__parameters:
    joints: [shoulder]
""",
    },
    _arm(_MARK + _BLOCK + _JOINTS),
    {
        "@ros2": f"{_MANAGER},",
        "urdf/arm.urdf.xacro": f'<robot name="arm"><link name="base"/>{ros2_control()}</robot>',
        "config/arm.yaml": f"""controller_manager:
  ros__parameters:
    arm: {{type: forward_command_controller/ForwardCommandController}}
arm:{_MARK}
  ros__parameters:
    first_joint: shoulder_pan
""",
    },
    _trajectories(f"joints: [shoulder]{_MARK}"),
    _trajectories(f"joints: [shoulder]{_MARK}\n    gains: {{shoulder: {{p: 0.0}}}}", "effort"),
    _arm(f"{_BLOCK}{_JOINTS}    wheel_radius: 0.1\n    wheel_separation: 1{_MARK}"),
    _arm(_BLOCK + _JOINTS + _SIZES + f"    open_loop: 1{_MARK}"),
    _arm(_BLOCK + _JOINTS + _SIZES + f"    twist_covariance_diagonal: [0, 1, 2]{_MARK}"),
    _arm(_BLOCK + _JOINTS + _SIZES, f"update_rate: 100.0{_MARK}"),
]
