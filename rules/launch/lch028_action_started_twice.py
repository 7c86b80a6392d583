"""A launch file that starts the same action twice.

An action is an object, and can be executed once. If it stands in the launch description and in the
actions of an event or a timer as well, or in two of them, the second execution raises
`ExecuteLocal action '…': executed more than once`, and the launch shuts down everything that it
has started. Often a node was moved into an event handler and stayed in the list.

It is reported for nodes and processes that both places start without a condition, or with those
that hold by default.

Fix: leave the action where it is to start, and remove it from the other place; to start a program
twice, make two actions. A node that is to be restarted has `respawn=True`.
Source: launch, `ExecuteLocal.execute` (in Foxy `ExecuteProcess.execute`) and
`LaunchService._run_async`.
"""

from collections.abc import Iterable, Iterator

from checker.launch.ros2.graph import Node, Process, Ros2Launch
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH028", "action-started-twice", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report nodes and processes of which two starts are one and the same action."""
    for graph in launch.entries:
        for action in _again((*graph.nodes, *graph.processes)):
            yield finding(
                action,
                f"{_label(action)} is started a second time, by an event: this ends the launch "
                "with 'executed more than once'; remove it from one of the two places",
            )


def _again(actions: Iterable[Node | Process]) -> Iterator[Node | Process]:
    """Yield the actions that an event starts a second time; each has a span of its own."""
    seen: set[int] = set()
    for action in actions:
        if not action.starts:
            continue
        if id(action.span) in seen and action.after:
            yield action
        seen.add(id(action.span))


def _label(action: Node | Process) -> str:
    if isinstance(action, Node):
        return f"node {action.executable.value!r}"
    return f"process {' '.join(word.value for word in action.words[:2])!r}"


_FILE = """from launch import LaunchDescription
from launch.actions import ExecuteProcess, RegisterEventHandler, TimerAction
from launch.event_handlers import OnProcessExit
from launch_ros.actions import Node


def spawner(name):
    return Node(package='controller_manager', executable='spawner', arguments=[name])


def generate_launch_description():
    create = Node(package='ros_gz_sim', executable='create')
    arm = Node(package='controller_manager', executable='spawner', arguments=['arm'])@
    record = ExecuteProcess(cmd=['ros2', 'bag', 'record', '-a'])%
    return LaunchDescription([
        create, {}
    ])
"""


def _file(actions: str, *, node: str = "", process: str = "") -> dict[str, object]:
    text = _FILE.replace("{}", actions).replace("@", node).replace("%", process)
    return {"@ros2": True, "launch/start.launch.py": text}


_EVENT = "RegisterEventHandler(OnProcessExit(target_action=create, on_exit=[{}])),"
_MARK = "  # ^ LCH028"
GOOD = [
    _file(_EVENT.format("arm")),
    _file(f"arm, {_EVENT.format('record')}"),
    _file("spawner('arm'), spawner('hand'), " + _EVENT.format("spawner('leg')")),
    _file(f"*[spawner(name) for name in ('a', 'b')], {_EVENT.format('arm')}"),
    _file("TimerAction(period=5.0, actions=[spawner(name) for name in ('a', 'b')])"),
]
BAD = [
    _file(f"arm, {_EVENT.format('arm')}", node=_MARK),
    _file("record, TimerAction(period=5.0, actions=[record])", process=_MARK),
    _file(f"{_EVENT.format('arm')} {_EVENT.format('arm')}", node=_MARK),
]
