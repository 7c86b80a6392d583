"""A move_group that gets no controllers, although the package has moveit_controllers.yaml.

move_group plans, and cannot execute: it logs "No paths can be executed", or takes the only plugin
of controller managers that is installed, which gets no `controller_names`. Execute in RViz fails.

It is reported where all parameters of move_group are known.

Fix: add the content of moveit_controllers.yaml to the parameters of move_group, as
`MoveItConfigsBuilder(...).trajectory_execution()` does. Or set `allow_trajectory_execution: false`.
Source: MoveIt 2, TrajectoryExecutionManager: parameter `moveit_controller_manager`.
"""

import posixpath

from checker.package.package import Package
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule

_PROGRAM = "moveit_ros_move_group/move_group"
_FILE = "moveit_controllers.yaml"
_NEEDED = "moveit_controller_manager"
_TAKEN = (_NEEDED, "moveit_simple_controller_manager")
"""The parameter, and those of the plugin that is taken without it where it alone is installed."""


@rule("WIR012", "move-group-without-controllers", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring, package: Package) -> Findings:
    """Report nodes move_group without the parameter moveit_controller_manager."""
    files = [file.path for file in package.index.with_suffix(_FILE)]
    file = next((path for path in files if posixpath.basename(path) == _FILE), "")
    for node in wiring.nodes if file else ():
        executes = node.settings.get("allow_trajectory_execution")
        if (
            node.program == _PROGRAM
            and node.knows_parameters
            and not any(name.startswith(_TAKEN) for name in node.settings)
            and (executes is None or executes.text != "false")
        ):
            yield finding(
                node.node.executable,
                f"move_group gets no {_NEEDED}, so it plans and cannot execute: add the "
                f"parameters of {file}",
                related=[(package.place(file), "the parameters")],
            )


_NODE = """
        Node(package="moveit_ros_move_group", executable="move_group",{}
             parameters=[{{"planning_pipelines": ["ompl"]{}}}]),
"""
_HEAD = "LaunchDescription([\n"
_CONTROLLERS = f"{_NEEDED}: moveit_simple_controller_manager/MoveItSimpleControllerManager\n"


def _example(more: str, mark: str = "", file: str = _FILE) -> dict[str, object]:
    return {
        "@bridge": True,
        "@launch": {_HEAD: _HEAD + _NODE.format(mark, more)},
        f"config/{file}": _CONTROLLERS,
    }


GOOD = [
    _example(f', "{_NEEDED}": "moveit_simple_controller_manager/MoveItSimpleControllerManager"'),
    _example(', "allow_trajectory_execution": False'),
    _example(', "moveit_simple_controller_manager": {"controller_names": ["arm"]}'),
    _example("", file="controllers_of_moveit.yaml"),
]
BAD = [_example("", "  # ^ WIR012")]
