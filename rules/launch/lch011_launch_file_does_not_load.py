"""A launch file that does not load, or not with its own defaults.

It is not valid Python, XML or YAML, defines no `generate_launch_description`, uses a name that is
neither defined nor imported, or that its function assigns only further down, imports a class from
another module of launch than its own, calls a tuple like a function, since a comma is missing,
includes itself, or has a default that is not among its choices.

Fix: correct what the message names; `ros2 launch PACKAGE FILE --show-args` shows the same error.
Source: launch, `PythonLaunchDescriptionSource`, `DeclareLaunchArgument`.
"""

from checker.launch.ros2.graph import LaunchFaultKind, Ros2Launch
from checker.rule import Concern, Findings, Severity, Unchecked, finding, rule, unchecked

_KINDS = (
    LaunchFaultKind.SYNTAX,
    LaunchFaultKind.NO_DESCRIPTION,
    LaunchFaultKind.UNDEFINED_NAME,
    LaunchFaultKind.CALL,
    LaunchFaultKind.INCLUDE_LOOP,
    LaunchFaultKind.UNKNOWN_CHOICE,
)


@rule("LCH011", "launch-file-does-not-load", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report launch files that end with an error, and name what of them is not read."""
    for reason in launch.unread:
        yield unchecked(reason)
    for graph in launch.entries:
        for fault in graph.faults:
            if fault.kind in _KINDS:
                yield finding(fault, fault.message)
        broken = any(fault.kind in _KINDS for fault in graph.faults)
        for unread in graph.unread if not broken else ():
            place = unread.span.place()
            if not place.file.startswith("../"):
                reason = f"{place.file}:{place.line}: {unread.reason}"
                yield Unchecked(reason, None if unread.by_default else Severity.WARNING)


_ARGUMENT = "        DeclareLaunchArgument('x', choices=['a', 'b'], default_value='@'),"


def _python(statements: str) -> dict[str, object]:
    return {
        "@ros2": True,
        "launch/more.launch.py": f"""from launch import LaunchDescription


def generate_launch_description():
    text = str(1)
{statements}
    return LaunchDescription([])
""",
    }


GOOD = [
    {"@ros2": True},
    {"@ros2": _ARGUMENT.replace("@", "a")},
    _python("    for c in text:\n        if c == 'b':\n            print(a)\n        a = c"),
    _python("    print([n for n in text if n])\n    n = 1\n    n = n + 1"),
    _python("    def later():\n        return n\n    n = 1\n    print(later())"),
    _python("    try:\n        print(n)\n    except NameError:\n        n = 1"),
]
BAD = [
    {
        "@ros2": True,
        "launch/more.launch.py": """from launch import LaunchDescription
from launch.substitutions import FindPackageShare  # ^ LCH011


def generate_launch_description():
    return LaunchDescription([])
""",
    },
    _python("    if text:\n        nodes.append(text)  # ^ LCH011\n    nodes = [text]"),
    _python("    nodes += [text]  # ^ LCH011"),
    {"@ros2": f"{_ARGUMENT.replace('@', 'c')}  # ^ LCH011"},
    {"@ros2": True, "launch/view.launch.xml": "<launch><node></launch> <!-- ^ LCH011 -->"},
    {
        "@ros2": True,
        "launch/view.launch.xml": """<launch>
  <include file="$(dirname)/view.launch.xml"/> <!-- ^ LCH011 -->
</launch>
""",
    },
    {
        "@ros2": "        Node(package='p' executable='e'),  # ^ LCH011",
    },
    {
        "@ros2": "        Node(package='p', executable='e', output='a', output='b'),  # ^ LCH011",
    },
    {
        "@ros2": """        Node(package='p', executable='e', remappings=[
            ('a', 'b')('c', 'd'),  # ^ LCH011
        ]),""",
    },
    {
        "@ros2": "        Node(package='p', executable=program),  # ^ LCH011",
    },
]
