"""A condition of a launch file that is neither true nor false.

`IfCondition`, `UnlessCondition` and the attributes `if` and `unless` take true, false, 1 and 0, in
any case. The launch ends with an error at anything else.

Fix: write one of these, or compare: `PythonExpression(["'", x, "' == 'sim'"])`.
Source: launch, `evaluate_condition_expression`.
"""

from checker.launch.ros2.graph import LaunchFaultKind, Ros2Launch
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH010", "non-boolean-condition", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report conditions of another text, with the defaults of arguments."""
    for graph in launch.entries:
        for fault in graph.faults:
            if fault.kind is LaunchFaultKind.CONDITION:
                yield finding(fault, fault.message)


_NODE = """        DeclareLaunchArgument('mode', default_value='@'),
        Node(package='p', executable='e', condition=IfCondition(LaunchConfiguration('mode'))),"""

GOOD = [{"@ros2": _NODE.replace("@", word)} for word in ("true", "False", "1")]
BAD = [{"@ros2": f"{_NODE.replace('@', word)}  # ^ LCH010"} for word in ("sim", "yes")]
