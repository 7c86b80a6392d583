"""A spawned controller that the controller manager cannot load.

A spawner asks the controller manager to load controllers by their names. The manager must know the
type of each: by `<name>: {type: …}` in its own parameters, or by the file that the spawner gets as
`--param-file`. Otherwise the spawner ends with "The 'type' param was not defined". A controller of
ros2_controllers is not configured either if no file has parameters that it requires.

Without a controller manager, spawners wait forever: either `ros2_control_node` runs it, or a plugin
in Gazebo. Both together: WIR022.

A joint state broadcaster that is configured, but not started with the other controllers, is a
warning: nothing publishes /joint_states, and no moving link has a transform.

Fix: write the same name in the launch file, below `controller_manager` and as the key of the
controller's block, state its `type` and its parameters, and start one controller manager.
Source: ros2_control, controller_manager/spawner.py and `ControllerManager::load_controller`.
"""

from collections.abc import Iterator

from msgspec.structs import replace

from checker.base.words import Suggestions, and_list
from checker.package.package import Package
from checker.ros.ros2_control.distributions import (
    controller_types,
    distribution_of,
)
from checker.ros.ros2_control.launched import LaunchedControl
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
)
from checker.rulebook.example_parts import gazebo_control, model_beside

_STATE_BROADCASTER = "joint_state_broadcaster/JointStateBroadcaster"


@rule("R2C013", "controller-not-spawnable", Severity.ERROR, Concern.INTERFACE)
def check(launched: LaunchedControl, package: Package, context: Context) -> Findings:
    """Report controllers without type or parameters, and launch files without a manager.

    Files that could not be read may say more: then nothing is reported of what they could hold. A
    launch file without a manager is a warning.
    """
    yield from _no_states(launched, package)
    yield from _no_parameters(launched, package, distribution_of(context))
    if not launched.managers and not launched.in_gazebo:
        yield from _no_manager(launched)
        return
    files = [it for each in launched.in_gazebo for manager in each.managers for it in manager.files]
    # R2C006 reports a file that is not there.
    listed = launched.listed_controllers if all(it.exists for it in files if it.path) else None
    for spawner in launched.spawners if listed is not None else ():
        typed = launched.typed_controllers(spawner)
        if typed is None or listed is None or spawner.states_type or not spawner.complete:
            continue
        suggestions = Suggestions((*listed, *typed))
        started = {name.value for each in launched.spawners for name in each.names}
        idle = sorted({*listed, *typed} - started)
        for name in spawner.names:
            if name.value not in listed and name.value not in typed:
                found = misspelt(
                    name,
                    f"controller {name.value!r} has no type in the parameters of the controller "
                    "manager or of its spawner",
                    suggestions,
                )
                words = name.value.rpartition("_")[0]
                is_meant = len(idle) == 1 and bool(words) and idle[0].startswith(words)
                yield replace(found, fix=found.fix or (rename(name, idle[0]) if is_meant else None))


def _no_states(launched: LaunchedControl, package: Package) -> Iterator[Finding]:
    spawned = [name.value for spawner in launched.spawners for name in spawner.names]
    complete = launched.is_complete and all(spawner.complete for spawner in launched.spawners)
    broadcasters = [it for it in launched.controllers if it.type.value == _STATE_BROADCASTER]
    own = [it.name for it in launched.controllers if it.name in spawned]
    started = {it.name for it in broadcasters} & {*spawned, *package.workspace.launch_words}
    for broadcaster in broadcasters if complete and own and not started else ():
        yield finding(
            broadcaster.span,
            f"no launch file starts {broadcaster.name!r} beside {own[0]!r}: nothing publishes "
            f"/joint_states; add {broadcaster.name} to the arguments of a spawner",
            severity=Severity.WARNING,
            key=broadcaster.name,
        )


def _no_parameters(
    launched: LaunchedControl, package: Package, distribution: str
) -> Iterator[Finding]:
    for controller, spawned in launched.bare_controllers:
        known = controller_types().get(controller.type.value)
        if known is None or not known.exists_in(distribution):
            continue
        lacking = known.lacking({*controller.parameters, *launched.inline}, distribution)
        if lacking and package.workspace.package(known.package) is None:
            yield finding(
                controller.span,
                f"{controller.label} is spawned without parameters, so it is not configured: write "
                f"{and_list(lacking)} below {controller.name}: ros__parameters:",
                related=[(spawned, "the spawner")],
            )


def _no_manager(launched: LaunchedControl) -> Iterator[Finding]:
    described = any(node.package.value == "robot_state_publisher" for node in launched.nodes)
    whole = launched.is_complete and launched.spawns_manager is False
    if launched.controls and whole and described:
        for spawner in launched.spawners:
            yield finding(
                spawner.node,
                "spawner waits forever: no controller manager is started, neither by "
                "ros2_control_node nor by a plugin of Gazebo",
                severity=Severity.WARNING,
                key="no manager",
            )


_HARDWARE = """
<ros2_control name="arm" type="system">
  <hardware><plugin>@</plugin></hardware>
  <joint name="shoulder"><command_interface name="position"/></joint>
</ros2_control>
"""
_GAZEBO = """
<gazebo>
  <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
    <parameters>$(find acme_arm_description)/config/arm.yaml</parameters>
  </plugin>
</gazebo>
"""
_YAML = """controller_manager:
  ros__parameters:
    arm_controller: {type: joint_trajectory_controller/JointTrajectoryController}
"""
_ARM = """arm_controller:
  ros__parameters:
    joints: [shoulder]
    command_interfaces: [position]
    state_interfaces: [position]
"""
_OWN = """grip_controller:
  ros__parameters:
    type: forward_command_controller/ForwardCommandController
"""
_NODE = "Node(package='controller_manager', executable='ros2_control_node', parameters=[config])"
_STATES = "Node(package='robot_state_publisher', executable='robot_state_publisher')"
_CREATE = "Node(package='ros_gz_sim', executable='create', arguments=['-name', 'arm'])"


def _spawner(*words: str, mark: str = "") -> str:
    arguments = ", ".join(word if word == "config" else repr(word) for word in words)
    inside = f"{arguments}{mark}\n        " if mark else arguments
    return f"Node(package='controller_manager', executable='spawner', arguments=[{inside}])"


def _command(line: str, mark: str = "") -> str:
    """Return the start of a controller by a command."""
    words = ["bash", "-c", f"sleep 5; ros2 control {line}"]
    return f"ExecuteProcess(cmd={words}{mark}\n        )"


def _arm(*nodes: str, gazebo: bool = False, more: str = "", block: str = _ARM) -> dict[str, object]:
    hardware = "gz_ros2_control/GazeboSimSystem" if gazebo else "mock_components/GenericSystem"
    started = ",\n        ".join(nodes)
    return {
        "@urdf": _HARDWARE.replace("@", hardware) + (_GAZEBO if gazebo else ""),
        "config/arm.yaml": _YAML + more + block + _OWN,
        "launch/arm.launch.py": f"""import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import ExecuteProcess, IncludeLaunchDescription
from launch_ros.actions import Node

CLASSIC = get_package_share_directory('gazebo_ros') + '/launch/gazebo.launch.py'


def generate_launch_description():
    share = get_package_share_directory('acme_arm_description')
    config = os.path.join(share, 'config', 'arm.yaml')
    return LaunchDescription([
        {started},
    ])
""",
    }


def _in_gazebo(controller: str, parameters: str, mark: str = "") -> object:
    """Return an arm in Gazebo whose plugin names a file of parameters by another path."""
    arm = _arm(_spawner(controller, mark=mark), _CREATE, gazebo=True)
    urdf = str(arm["@urdf"]).replace("$(find acme_arm_description)", parameters)
    return {**arm, "@urdf": urdf}


def _model_spawned(joint: str, plugin: str, mark: str = "") -> object:
    """Return an arm that is spawned as the SDF model of another package."""
    model = "get_package_share_directory('acme_arm_model') + '/model.sdf'"
    create = f"Node(package='ros_gz_sim', executable='create', arguments=['-file', {model}])"
    spawner = _spawner("arm_controller").replace("Node(", f"Node({mark}\n            ")
    return {**_arm(_STATES, create, spawner), **model_beside(joint, plugin)}


def _robot_beside(controller: str, mark: str = "") -> object:
    """Return an arm whose launch file spawns the arm of another package instead."""
    model = "get_package_share_directory('acme_arm_tall') + '/arm.urdf'"
    create = _CREATE.replace("'-name', 'arm'", f"'-file', {model}")
    robot = f"""<robot name="arm">
  <link name="base_link"/>
  <link name="upper_arm"/>
  <joint name="shoulder" type="continuous">
    <parent link="base_link"/><child link="upper_arm"/>
  </joint>
  {_HARDWARE.replace("@", "gz_ros2_control/GazeboSimSystem")}{_GAZEBO}
</robot>
"""
    return {
        **_arm(_spawner(controller, mark=mark), create, gazebo=True),
        "../acme_arm_tall/package.xml": "<package><name>acme_arm_tall</name></package>",
        "../acme_arm_tall/arm.urdf": robot.replace("acme_arm_description", "acme_arm_tall"),
        "../acme_arm_tall/config/arm.yaml": (_YAML + _ARM).replace("arm_", "tall_arm_"),
    }


def _in_classic(*nodes: str, more: str) -> object:
    """Return an arm in Gazebo Classic, whose own launch file starts no controller manager."""
    plugin = _GAZEBO.replace("gz_ros2_control-system", "libgazebo_ros2_control.so")
    return {
        **_arm("IncludeLaunchDescription(CLASSIC)", *nodes, more=more),
        "@urdf": _HARDWARE.replace("@", "gazebo_ros2_control/GazeboSystem") + plugin,
    }


_MARK = "  # ^ R2C013"
_INSTALLED = "/home/ann/ws/install/acme_arm_description/share/acme_arm_description"
_BROADCASTER = f"    joints_out:\n      type: {_STATE_BROADCASTER}{_MARK}\n"
GOOD = [
    _robot_beside("tall_arm_controller"),
    _model_spawned("shoulder", gazebo_control("")),
    _arm(_NODE, _spawner("arm_controller", "joints_out"), more=_BROADCASTER.replace(_MARK, "")),
    _in_classic(_spawner("arm_controller", "joints_out"), more=_BROADCASTER.replace(_MARK, "")),
    _arm(_NODE, _spawner("arm_controller")),
    _arm(_NODE, _spawner("arm_controller", "--param-file", "config"), block=""),
    _arm(
        _NODE,
        _spawner("arm_controller"),
        _command(
            "load_controller joints_out && ros2 control set_controller_state joints_out active"
        ),
        more=_BROADCASTER.replace(_MARK, ""),
    ),
    _arm(_NODE, _spawner("grip_controller", "--param-file", "config")),
    _arm(_spawner("arm_controller"), _CREATE, gazebo=True),
    _in_gazebo("arm_controller", _INSTALLED),
    _in_gazebo("arm_controler", "/home/ann/arm"),
]
BAD = [
    _robot_beside("arm_controller", _MARK),
    _model_spawned("shoulder", "", _MARK),
    _in_gazebo("arm_controler", _INSTALLED, _MARK),
    _in_classic(_spawner("arm_controller"), more=_BROADCASTER),
    _arm(_NODE, _spawner("arm_controller"), more=_BROADCASTER),
    _arm(_NODE, _spawner("arm_controler", mark=_MARK)),
    _arm(_NODE, _command("load_controller --set-state active arm_controler", _MARK)),
    _arm(_NODE, _command("switch_controllers --activate arm_controller"), more=_BROADCASTER),
    {
        **_arm(_NODE, _spawner("arm_controller"), block=""),
        "config/arm.yaml": _YAML.replace("}\n", f"}}{_MARK}\n"),
    },
    _arm(_NODE, _spawner("grip_controller", mark=_MARK)),
    _arm(_STATES, _spawner("arm_controller").replace("Node(", f"Node({_MARK}\n            ")),
]
