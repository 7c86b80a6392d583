"""A file of parameters whose blocks are for nodes in another namespace.

A block of a parameter file is for the node of that full name: `controller_manager:` is only for
`/controller_manager`. A controller manager that Gazebo starts in a namespace does not read it, and
neither do its controllers; the spawner then reports that a type is not defined. Without
`ros__parameters` below the name, the parameters are not read.

It is an error where the block of the manager itself is not read: it does not know its controllers
and its rate. The block of a controller alone is a warning.

A file with a block of the same node for the manager's namespace is for several robots: its blocks
for other namespaces are not reported.

Fix: put the blocks below the key of the namespace, or below two asterisks for any namespace, as in
the examples.
Source: rcl_yaml_param_parser; rclcpp, `parameter_map_from`.
"""

import posixpath

from checker.model.ros_parameters import unread_blocks
from checker.ros.ros2_control.robot_control import RobotControl
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import GAZEBO, gazebo_control, ros2_control


@rule("R2C012", "unread-parameter-block", Severity.WARNING, Concern.INTERFACE)
def check(control: RobotControl) -> Findings:
    """Report blocks that no node of the robot's namespace reads."""
    for file in control.files:
        for key in file.bare:
            message = f"{key.text} has no ros__parameters below it, so its parameters are not read"
            yield finding(key, message, covered_by=("WIR007",))
    if len(control.managers) != 1:
        return
    manager = control.managers[0]
    namespace = manager.namespace
    names = {manager.node, *(controller.name for controller in control.controllers)}
    for file in control.files if control.is_named else ():
        unread = [*unread_blocks(file.blocks, namespace.value, names)]
        of_manager = any(posixpath.basename(block.name) == manager.node for block in unread)
        for block in unread:
            yield finding(
                block.span,
                f"the parameters are for {block.name}, but the controller manager runs in "
                f"{namespace.value}",
                severity=Severity.ERROR if of_manager else Severity.WARNING,
                key=namespace.value,
                related=[(namespace, "the namespace")],
            )


_PARAMETERS = "<parameters>$(find acme_arm_description)/config/arm.yaml</parameters>\n"


def _arm(blocks: str, ros: str = "<ros><namespace>robot</namespace></ros>") -> object:
    return {
        "@urdf": ros2_control(hardware=GAZEBO) + gazebo_control(_PARAMETERS + ros),
        "config/arm.yaml": blocks,
    }


def _manager(name: str, mark: str = "") -> str:
    return f"{name}:{mark}\n  ros__parameters:\n    update_rate: 100\n"


_MARK = "  # ^ R2C012"
GOOD = [
    _arm(_manager("controller_manager"), ""),
    _arm(_manager("/**/controller_manager")),
    _arm(_manager("/robot/controller_manager")),
    _arm(_manager("/**")),
    _arm(_manager("/robot/controller_manager") + _manager("/other/controller_manager")),
    _arm("robot:\n  controller_manager:\n    ros__parameters:\n      update_rate: 100\n"),
]
BAD = [
    _arm(_manager("controller_manager", _MARK)),
    _arm(_manager("/other/controller_manager", _MARK)),
    _arm(f"controller_manager:{_MARK}\n  update_rate: 100\n", ""),
]
