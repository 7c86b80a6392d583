"""A controller that MoveIt's controller manager drops.

`moveit_simple_controller_manager` needs of each controller in `controller_names` its `action_ns`,
its `type` and its `joints`. Where one is missing it logs "No action namespace specified for
controller" (type, joints), and goes on without the controller: plans are made, and executing one
fails with "Unable to identify any set of controllers that can actuate the specified joints". The
setup assistant leaves `action_ns` out at times, in Humble and in Jazzy.

Fix: write `action_ns: follow_joint_trajectory` for a FollowJointTrajectory, `gripper_cmd` for a
GripperCommand, and the joints of the controller.
Source: moveit/moveit2#1394, #1506, #3566; MoveIt 2, moveit_simple_controller_manager.cpp.
"""

from collections.abc import Iterator

from checker.base.words import Suggestions, and_list
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Located
from checker.source.yaml import YamlNode, read_root

_MANAGER = "moveit_simple_controller_manager"
_NAMES = "controller_names"
_NEEDED = ("action_ns", "type", "joints")
_ACTIONS = {"FollowJointTrajectory": "follow_joint_trajectory", "GripperCommand": "gripper_cmd"}


@rule("URD036", "controller-dropped-by-moveit", Severity.ERROR, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report controllers of the simple controller manager that lack what it needs."""
    for file in package.index.with_suffix("controllers.yaml"):
        root = read_root(package.read(file.path))
        manager = root.get(_MANAGER) if root is not None else None
        chosen = root.get("moveit_controller_manager") if root is not None else None
        other = chosen is not None and not str(chosen.scalar).startswith(f"{_MANAGER}/")
        names = manager.get(_NAMES) if manager is not None else None
        if manager is not None and names is not None and not other:
            for item in names.items:
                if isinstance(item.scalar, str) and "$" not in item.scalar:
                    yield from _judged(Located(item.scalar, item.span), manager)


def _judged(name: Located[str], manager: YamlNode) -> Iterator[Finding]:
    controller = manager.get(name.value)
    if controller is None:
        others = [str(key.scalar) for key, _ in manager.entries if key.scalar != _NAMES]
        if not any(it.startswith(f"{name.value}.") for it in others):
            near = Suggestions(others).hint(name.value)
            message = f"MoveIt drops controller {name.value!r}: there is no block of this name"
            yield finding(name, f"{message}{near}", key=name.value)
        return
    missing = [it for it in _NEEDED if controller.get(it) is None]
    if controller.kind == "mapping" and missing:
        kind = controller.get("type")
        meant = Suggestions(missing)
        action = _ACTIONS.get(str(kind.scalar) if kind is not None else "")
        slips = [key for key, _ in controller.entries if meant.closest(str(key.scalar))]
        cure = f"; write `action_ns: {action}`" if missing[0] == "action_ns" and action else ""
        yield finding(
            name,
            f"MoveIt drops controller {name.value!r}, which has no {and_list(missing)}{cure}",
            key=name.value,
            related=[(slip, "misspelt, so not read") for slip in slips],
        )


def _controllers(lines: str, mark: str = "", manager: str = _MANAGER) -> dict[str, object]:
    return {
        "@urdf": True,
        "config/moveit_controllers.yaml": f"""moveit_controller_manager: {manager}/Manager
{_MANAGER}:
  controller_names:
    - arm_controller{mark}
{lines}
""",
    }


_WHOLE = """  arm_controller:
    action_ns: follow_joint_trajectory
    type: FollowJointTrajectory
    joints: [shoulder]
"""
_MARK = "  # ^ URD036"
GOOD = [
    _controllers(_WHOLE),
    _controllers("", manager="moveit_ros_control_interface"),
]
BAD = [
    _controllers("", _MARK),
    _controllers(_WHOLE.replace("action_ns", "actions_ns"), _MARK),
    _controllers(_WHOLE.replace("    type: FollowJointTrajectory\n", ""), _MARK),
    _controllers(_WHOLE.replace("    joints: [shoulder]\n", ""), _MARK),
]
