"""A start that waits for the end of a process that does not end.

`OnProcessExit` starts its actions when the process of `target_action` has ended. ros2_control_node,
robot_state_publisher, Gazebo and bridges run until the launch is stopped: controllers whose
spawners wait for them are never started, and the robot does not move. The usual target is a program
that does its work and ends: the one that spawns the model, or the spawner of another controller.

It is reported for spawners of controllers, and for other nodes that wait for a node which only the
launch stops: after a window is closed, such as that of RViz, a program may well be started. What
starts the same program again is no fault.

Fix: `OnProcessStart`, or the end of the node that spawns the model; a spawner waits for its
controller manager anyway, and needs no event.
Source: launch, `OnProcessExit` and `OnProcessStart`; gz_ros2_control_demos, where the broadcaster
waits for the end of `create`.
"""

from checker.launch.ros2.graph import LaunchGraph, Node, Process, Ros2Launch
from checker.ros.ros2_control.launched import MANAGER_NODE, spawner_of
from checker.ros.servers import CLASSIC_COMMANDS, is_gazebo
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import Span

_ENDLESS = (
    MANAGER_NODE,
    *("robot_state_publisher", "joint_state_publisher", "move_group"),
    *("parameter_bridge", "bridge_node", "static_transform_publisher"),
)
"""Programs that run until the launch stops them."""
_GAZEBO = "Gazebo"
_WINDOWS = (_GAZEBO, "rviz2", "joint_state_publisher_gui")
"""Programs that may also end because a user closes their window."""
_ENDS = "--iterations"
"""An option with which Gazebo ends by itself."""


@rule("LCH022", "waits-for-endless-process", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report what starts at the end of a node or command that runs until the launch is stopped."""
    for graph in launch.entries:
        for node in graph.nodes_and_spawns:
            if node.exit_of is None or not node.starts:
                continue
            target = _endless(graph, node.exit_of, by_user=spawner_of(node) is not None)
            if target and target != node.executable.value:
                yield finding(
                    node,
                    f"{node.executable.value} starts only when {target} ends, which runs until the "
                    "launch is stopped: use OnProcessStart, or the exit of a program that ends",
                    key=target,
                    related=[(node.exit_of, "it waits for the end of this")],
                )


def _endless(graph: LaunchGraph, action: Span, *, by_user: bool) -> str:
    """Return the program that an action starts, if it does not end by itself; else nothing.

    Args:
        graph: The launch.
        action: The action.
        by_user: Whether programs count that a user may end.
    """
    every: tuple[Node | Process, ...] = (*graph.nodes, *graph.processes)
    started = [it for it in every if it.span is action]
    programs = [_program(it) for it in started]
    endless = (*_ENDLESS, *_WINDOWS) if by_user else _ENDLESS
    certain = all(it.starts for it in started) and all(it in endless for it in programs)
    return programs[0] if programs and certain else ""


def _program(started: Node | Process) -> str:
    """Return the program of a node, or the name of Gazebo; nothing of other commands."""
    if isinstance(started, Node):
        return started.executable.value
    words = [word.value for word in started.words]
    runs = is_gazebo(started) or words[:1] in ([name] for name in CLASSIC_COMMANDS)
    return _GAZEBO if runs and _ENDS not in words else ""


_FILE = """from launch import LaunchDescription
from launch.actions import ExecuteProcess, RegisterEventHandler
from launch.event_handlers import OnProcessExit, OnProcessStart
from launch_ros.actions import Node


def generate_launch_description():
    manager = Node(package='controller_manager', executable='ros2_control_node')
    rviz = Node(package='rviz2', executable='rviz2')
    gazebo = ExecuteProcess(cmd=['gz', 'sim', '-r', 'empty.sdf'])
    create = Node(package='ros_gz_sim', executable='create')
    spawner = Node(package='controller_manager', executable='spawner', arguments=['arm'])@
    filter = Node(package='robot_localization', executable='ekf_node')%
    return LaunchDescription([
        manager, rviz, gazebo, create,
        RegisterEventHandler({}),
    ])
"""


def _event(event: str, spawner: str = "", other: str = "") -> dict[str, object]:
    text = _FILE.replace("{}", event).replace("@", spawner).replace("%", other)
    return {"@ros2": True, "launch/start.launch.py": text}


_MARK = "  # ^ LCH022"
GOOD = [
    _event("OnProcessExit(target_action=create, on_exit=[spawner])"),
    _event("OnProcessStart(target_action=manager, on_start=[spawner])"),
    _event("OnProcessExit(target_action=manager, on_exit=[manager])"),
    _event("OnProcessExit(target_action=rviz, on_exit=[filter])"),
]
BAD = [
    _event("OnProcessExit(target_action=manager, on_exit=[spawner])", _MARK),
    _event("OnProcessExit(target_action=gazebo, on_exit=[spawner])", _MARK),
    _event("OnProcessExit(target_action=manager, on_exit=[filter])", other=_MARK),
]
