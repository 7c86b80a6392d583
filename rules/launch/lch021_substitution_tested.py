"""A substitution that Python tests as if it were its value.

`LaunchConfiguration('sim') == 'true'` compares an object with a text, while the launch file is
read: it is always false, whatever the user passes, and `if LaunchConfiguration('sim'):` is always
true. The other branch never runs: other nodes start, or other parameters count, than the arguments
say.

Fix: give the action a condition, `IfCondition(LaunchConfiguration('sim'))`; choose a value by a
`PythonExpression`; or read it in an `OpaqueFunction`, with `.perform(context)`.
Source: launch, `Substitution.perform`: the value exists when the launch runs.
"""

from checker.launch.ros2.graph import LaunchFaultKind, Ros2Launch
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH021", "substitution-tested", Severity.WARNING, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report comparisons and tests of substitutions."""
    for graph in launch.entries:
        for fault in graph.faults:
            if fault.kind is LaunchFaultKind.COMPARISON:
                yield finding(
                    fault,
                    f"{fault.message}: it tests the substitution, not the value that launch gives "
                    "it; use IfCondition, or .perform(context) in an OpaqueFunction",
                )


_FILE = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    sim = LaunchConfiguration('sim')
    program = 'driver'
    @
        program = 'simulator'
    return LaunchDescription([
        DeclareLaunchArgument('sim', default_value='true'),
        Node(package='p', executable=program),
    ])
"""


def _test(code: str, mark: str = "") -> dict[str, object]:
    return {"@ros2": True, "launch/start.launch.py": _FILE.replace("@", code + mark)}


_MARK = "  # ^ LCH021"
GOOD = [
    _test("if program == 'driver':"),
    _test("if sim is None:"),
]
BAD = [
    _test("if sim == 'true':", _MARK),
    _test("if 'false' != sim:", _MARK),
    _test("if sim:", _MARK),
]
