"""A controller that MoveIt's controller manager drops or cannot reach.

`moveit_simple_controller_manager` needs of each controller in `controller_names` its `action_ns`,
its `type` and its `joints`. Where one is missing it logs "No action namespace specified for
controller" (type, joints), and goes on without the controller: plans are made, and executing one
fails with "Unable to identify any set of controllers that can actuate the specified joints". The
setup assistant leaves `action_ns` out at times, in Humble and in Jazzy.

MoveIt calls the action `<controller>/<action_ns>`. A JointTrajectoryController offers
`follow_joint_trajectory`, a GripperActionController `gripper_cmd`: with another `action_ns` MoveIt
logs "Action client not connected to action server", and nothing moves. A JointTrajectoryController
with other joints refuses each trajectory: "Joints on incoming goal don't match the controller
joints". Type and joints are those of the parameter files of all packages, where they agree and a
launch file names the controller.

Fix: write `action_ns: follow_joint_trajectory` for a FollowJointTrajectory, `gripper_cmd` for a
GripperCommand, and the joints of the controller.
Source: moveit/moveit2#1394, #1506, #3566; MoveIt 2, moveit_simple_controller_manager.cpp;
ros2_controllers, joint_trajectory_controller.cpp.
"""

from collections.abc import Iterator, Sequence
from itertools import islice

from checker.base.words import Suggestions, and_list
from checker.model.controllers import Controller, ControllerFile, controllers_of
from checker.package.package import Package
from checker.ros.wiring.parameters import blocks_in
from checker.rule import Concern, Finding, Findings, Severity, finding, rename, rule
from checker.source.text import Located
from checker.source.yaml import YamlNode, read_root

_MANAGER = "moveit_simple_controller_manager"
_NAMES = "controller_names"
_NEEDED = ("action_ns", "type", "joints")
_TRAJECTORIES = "joint_trajectory_controller/JointTrajectoryController"
_OFFERED = {
    _TRAJECTORIES: "follow_joint_trajectory",
    "position_controllers/GripperActionController": "gripper_cmd",
    "effort_controllers/GripperActionController": "gripper_cmd",
    "parallel_gripper_action_controller/GripperActionController": "gripper_cmd",
}
"""The action that a type of controllers offers, below the name of the controller."""
_FILES_LIMIT = 400
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
                    name = Located(item.scalar, item.span)
                    yield from _judged(name, manager)
                    yield from _refusing(name, manager.get(item.scalar), package)


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


def _refusing(name: Located[str], stated: YamlNode | None, package: Package) -> Iterator[Finding]:
    """Report what a configured controller of this name does not offer, or refuses."""
    # A driver of the gripper may have the name of a controller that no launch file names.
    if stated is None or not package.workspace.launches_with(name.value):
        return
    configured = [*_configured(name.value, package)]
    if len({it.type.value for it in configured}) == 1:
        yield from _unreached(configured[0], stated)
        yield from _with_other_joints(configured, stated)


def _unreached(controller: Controller, stated: YamlNode) -> Iterator[Finding]:
    action, right = stated.get("action_ns"), _OFFERED.get(controller.type.value)
    named = action.scalar if action is not None else None
    if action is None or not isinstance(named, str) or right in (None, named.strip("/")):
        return
    if named.strip("/"):
        yield finding(
            action,
            f"controller {controller.name!r} offers {right} and no {named}: MoveIt cannot move "
            f"its joints; write `action_ns: {right}`",
            key=controller.name,
            related=[(controller.type, "its type")],
            fix=rename(Located(named, action.span), str(right)),
        )


def _with_other_joints(configured: Sequence[Controller], stated: YamlNode) -> Iterator[Finding]:
    """Report joints of which a trajectory controller has others, in each of its files."""
    listed = stated.get("joints")
    meant = {str(it.scalar) for it in listed.items} if listed is not None else set()
    first = configured[0]
    for controller in configured if first.type.value == _TRAJECTORIES else ():
        joints = {it.value for it in controller.texts("joints")}
        partial = controller.flag("allow_partial_joints_goal", default=False)
        if not joints or joints == meant or (partial and meant < joints):
            return
        if any("$" in name for name in joints | meant):
            return
    if listed is not None and meant and first.type.value == _TRAJECTORIES:
        own = first.texts("joints")
        yield finding(
            listed,
            f"controller {first.name!r} refuses each trajectory: MoveIt sends joints "
            f"{and_list(sorted(meant))}, and it has {and_list([it.value for it in own])}; write "
            "the same joints in both files",
            key=first.name,
            related=[(own[0], "its joints")],
        )


def _configured(name: str, package: Package) -> Iterator[Controller]:
    """Yield the controllers of a name that the parameter files of all packages configure."""
    folders = ((package, ""), *((it, f"../{it.name}/") for it in package.other_packages))
    files = (f"{at}{it.path}" for holder, at in folders for it in holder.index.with_suffix(".yaml"))
    for path in islice(files, _FILES_LIMIT):
        blocks = tuple(blocks_in(package, path, name))
        found = controllers_of([ControllerFile(path, blocks)]) if blocks else ()
        yield from (it for it in found if it.name == name)


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
_TYPES = """controller_manager:
  ros__parameters:
    arm_controller: {type: joint_trajectory_controller/JointTrajectoryController}
arm_controller:
  ros__parameters:
    joints: [shoulder]
"""
_BESIDE = {"@name": "acme_arm_config", "../acme_arm_bringup/config/control.yaml": _TYPES} | {
    "../acme_arm_bringup/package.xml": "<package><name>acme_arm_bringup</name></package>"
}
_SPAWN = {
    "launch/arm.launch.xml": """<launch>
<node pkg="controller_manager" exec="spawner" args="arm_controller"/>
</launch>
"""
}
_OTHER = _WHOLE.replace(": follow_joint_trajectory", ": gripper_cmd")
_LONGER = _WHOLE.replace("[shoulder]", "[shoulder, elbow]")
GOOD = [
    _controllers(_WHOLE),
    {**_controllers(_WHOLE), **_BESIDE, **_SPAWN},
    {**_controllers(_OTHER), **_BESIDE},
    {**_controllers(_OTHER), **_SPAWN},
    _controllers("", manager="moveit_ros_control_interface"),
]
BAD = [
    _controllers("", _MARK),
    _controllers(_WHOLE.replace("action_ns", "actions_ns"), _MARK),
    _controllers(_WHOLE.replace("    type: FollowJointTrajectory\n", ""), _MARK),
    _controllers(_WHOLE.replace("    joints: [shoulder]\n", ""), _MARK),
    {**_controllers(f"{_LONGER.rstrip()}{_MARK}"), **_BESIDE, **_SPAWN},
    {**_controllers(_OTHER.replace("gripper_cmd", f"gripper_cmd{_MARK}")), **_BESIDE, **_SPAWN},
]
