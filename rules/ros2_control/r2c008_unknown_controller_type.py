"""A controller type that the ROS 2 distribution does not have.

The spawner ends with an error for a type that no package exports. Some types were renamed: the
`GripperActionController` of `position_controllers` and `effort_controllers` was removed in Kilted,
the `JointGroup…Controller`s since Lyrical. Types of ROS 1, such as
`joint_state_controller/JointStateController`, never existed in ROS 2.

Where no launch file names the controller outside of comments, nothing loads it: that is a warning.

An unknown type is not judged in a package for a distribution before Humble, or where a `.repos`
file names a fork of ros2_controllers. Types of other packages are not judged, unless the class has
the name of one of ros2_controllers and the package is neither in package.xml nor available.

Fix: `joint_state_broadcaster/JointStateBroadcaster` publishes joint states,
`joint_trajectory_controller/JointTrajectoryController` follows trajectories,
`parallel_gripper_action_controller/GripperActionController` closes grippers, and
`forward_command_controller/ForwardCommandController` with `interface_name` forwards commands.
Source: plugin descriptions of ros2_controllers, by branch.
"""

import re
from collections.abc import Iterator, Mapping

from msgspec.structs import replace

from checker.base.words import Suggestions
from checker.package.distribution_sign import former_distribution
from checker.package.files_above import files_around
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
    misspelt,
    rename,
    rule,
    unchecked,
)
from checker.rulebook.example_parts import SHOULDER, ros2_control
from checker.source.text import Located

_REPOSITORIES = re.compile(r"\.repos\Z")
_FORK = re.compile(r"[/:](?!ros-controls/)[\w.-]{1,100}/ros2_controllers\b")
_OF_ROS_1 = {"joint_state_controller"}
_FORWARDS = "forward_command_controller/ForwardCommandController with interface_name: "
_INSTEAD: Mapping[str, str] = {
    "joint_state_controller/JointStateController": "joint_state_broadcaster/JointStateBroadcaster",
    "position_controllers/JointTrajectoryController": (
        "joint_trajectory_controller/JointTrajectoryController"
    ),
    "effort_controllers/JointTrajectoryController": (
        "joint_trajectory_controller/JointTrajectoryController"
    ),
    "velocity_controllers/JointTrajectoryController": (
        "joint_trajectory_controller/JointTrajectoryController"
    ),
    "position_controllers/GripperActionController": (
        "parallel_gripper_action_controller/GripperActionController"
    ),
    "effort_controllers/GripperActionController": (
        "parallel_gripper_action_controller/GripperActionController"
    ),
    "position_controllers/JointGroupPositionController": f"{_FORWARDS}position",
    "velocity_controllers/JointGroupVelocityController": f"{_FORWARDS}velocity",
    "effort_controllers/JointGroupEffortController": f"{_FORWARDS}effort",
}


@rule("R2C008", "unknown-controller-type", Severity.ERROR, Concern.INTERFACE)
def check(control: ConfiguredControllers, context: Context, package: Package) -> Findings:
    """Report types of packages of ros2_controllers that these do not export.

    A class of ros2_controllers in a package that nothing declares or holds is a warning.
    """
    unknown = former_distribution(package) or _built_from_a_fork(package)
    distribution, types = distribution_of(context), controller_types()
    packages = {name.partition("/")[0] for name in types} | _OF_ROS_1
    current = [name for name in types if types[name].exists_in(distribution)]
    suggestions = Suggestions(current)
    for controller in control.controllers:
        name = controller.type.value
        owner = name.partition("/")[0]
        if package.workspace.package(owner) is not None:
            continue  # A package of that name is in the workspace, whatever it exports.
        if owner not in packages:
            yield from _another_package(controller.type, types, package)
            continue
        known = types.get(name)
        if known is None or not known.exists_in(distribution):
            if unknown:
                yield unchecked(f"{name}: {unknown}")
                continue
            words = package.workspace.started_words
            level = None if not words or controller.name in words else Severity.WARNING
            instead = _INSTEAD.get(name)
            message = f"ROS 2 {distribution.title()} has no controller of type {name}"
            if instead:
                message += f", expected {instead}"
                fix = rename(controller.type, instead)
                yield finding(controller.type, message, severity=level, fix=fix)
            else:
                found = misspelt(controller.type, message, suggestions)
                of_owner = [each for each in current if each.partition("/")[0] == owner]
                only = rename(controller.type, of_owner[0]) if len(of_owner) == 1 else None
                yield replace(found, severity=level, fix=found.fix or only)


def _built_from_a_fork(package: Package) -> str:
    """Return the clause that a `.repos` file names a fork of ros2_controllers; else empty."""
    for source in files_around(package, _REPOSITORIES):
        if fork := _FORK.search(source.text):
            return f"{source.where(fork.start())} names a fork of ros2_controllers"
    return ""


def _another_package(
    kind: Located[str], types: Mapping[str, ControllerType], package: Package
) -> Iterator[Finding]:
    owner, _, name = kind.value.partition("/")
    meant = [known for known in types if known.endswith(f"/{name}")]
    declared = {reference.package_name for reference in package.references}
    if meant and owner not in declared:
        yield finding(
            kind,
            f"controller type {kind.value} is of package {owner!r}, which package.xml does not "
            f"name; did you mean {meant[0]}?",
            severity=Severity.WARNING,
            key="package",
        )


_STATE = '<state_interface name="position"/>'
_POSITION = "    command_interfaces: [position]\n    state_interfaces: [position]\n"


def _arm(kind: str, parameters: str = "") -> dict[str, str]:
    return {
        "@urdf": ros2_control(SHOULDER.replace("</", f"{_STATE}</")),
        "config/arm.yaml": f"""controller_manager:
  ros__parameters:
    arm_controller:
      type: {kind}
arm_controller:
  ros__parameters:
    joints: [shoulder]
{parameters}""",
    }


GOOD = [
    _arm("joint_trajectory_controller/JointTrajectoryController"),
    _arm("position_controllers/GripperActionController"),
    _arm("acme_controllers/ArmController"),
    {
        **_arm("diff_drive_controller/ForkedController"),
        "../diff_drive_controller/package.xml": "<package/>",
    },
]
BAD = [
    _arm("joint_trajectory_controller/JointTrajectoryControler  # ^ R2C008", _POSITION),
    _arm("effort_controllers/JointEffortController  # ^ R2C008"),
    _arm("joint_state_controller/JointStateController  # ^ R2C008"),
    _arm("joint_trajectory/JointTrajectoryController  # ^ R2C008"),
]
