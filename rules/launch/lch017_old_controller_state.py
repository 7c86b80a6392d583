"""A controller state of ROS 2 Galactic and older in a command of ros2_control.

`ros2 control` ends with "invalid choice: 'start'", so the controller is not loaded and the robot
does not move. Since Humble, states are called `active` and `inactive`.

Fix: write `active` for `start`, and `inactive` for `configure` and `stop`; or use the `spawner` of
controller_manager.
Source: ros2_control pull request 755, ros2controlcli; gazebo_ros2_control pull request 146.
"""

from collections.abc import Mapping, Sequence

from checker.launch.ros2.graph import Ros2Launch
from checker.package.distribution_sign import former_distribution
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import Located

_STATES: Mapping[str, str] = {"start": "active", "configure": "inactive", "stop": "inactive"}
_LOADS, _CHANGES = "load_controller", "set_controller_state"
_OPTION = "--set-state"


@rule("LCH017", "old-controller-state", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report states that `ros2 control` of Humble and later does not know."""
    if former_distribution(package):
        return
    for graph in launch.entries:
        for process in graph.processes:
            for state in filter(None, map(_old_state, process.commands)):
                yield finding(
                    state,
                    f"ros2 control has no state {state.value!r}, and does not load the controller: "
                    f"expected {_STATES[state.value]!r}",
                    severity=None if process.starts is True else Severity.WARNING,
                    key=state.value,
                )


def _old_state(words: Sequence[Located[str]]) -> Located[str] | None:
    """Return the old state that a command of `ros2 control` requests."""
    said = [word.value for word in words]
    if said[:2] != ["ros2", "control"] or len(said) < 4:
        return None
    after = [words[i + 1] for i, word in enumerate(said[:-1]) if word == _OPTION]
    asked = {_CHANGES: [words[-1]], _LOADS: after}.get(said[2], [])
    return asked[0] if asked and asked[0].value in _STATES else None


def _command(words: str) -> dict[str, object]:
    start = f"ExecuteProcess(cmd={words.split()}, output='screen')"
    return {"@ros2": f"        {start},", "@profile": "ros2"}


def _marked(words: str, *, as_line: bool = False) -> object:
    cmd = f"['sleep 2 && {words}'], shell=True" if as_line else words.split()
    start = f"ExecuteProcess(cmd={cmd})"
    return {"@ros2": f"        {start},  # ^ LCH017", "@profile": "ros2"}


GOOD = [
    _command("ros2 control load_controller --set-state active arm_controller"),
    _command("ros2 run acme start"),
    {
        **_command("ros2 control load_controller --set-state start arm_controller"),
        "README.md": "A rover for ROS 2 Galactic.\n",
    },
    _command("ros2 control load_controller arm_controller"),
]
BAD = [
    _marked("ros2 control load_controller --set-state start arm_controller"),
    _marked("ros2 control set_controller_state arm_controller configure"),
    _marked("ros2 control load_controller --set-state start arm_controller", as_line=True),
]
