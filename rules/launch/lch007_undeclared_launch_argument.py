"""A launch argument that is used before it is declared, or never declared.

The launch ends with "launch configuration 'x' does not exist", unless the user gives `x:=…`.
Actions are visited in order: a declaration counts for what follows it, and for what an event such
as the end of a process starts. Arguments that an included file which is not available may declare
are not checked, nor are files that another available file includes.

Fix: add `DeclareLaunchArgument('x', default_value=…)` before its use.
Source: launch, `LaunchConfiguration.perform`: without a default, a missing one raises an error.
"""

import posixpath

from checker.launch.ros2.graph import LaunchFaultKind, Ros2Launch
from checker.launch.ros2.package_launch import launch_files
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import SourceText

_KINDS = (LaunchFaultKind.UNDECLARED_ARGUMENT, LaunchFaultKind.LATE_ARGUMENT)


@rule("LCH007", "undeclared-launch-argument", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report arguments without value where they are used."""
    for graph in launch.entries:
        faults = [fault for fault in graph.faults if fault.kind in _KINDS]
        if faults and not graph.unread and not _is_named(package, graph.file):
            for fault in faults:
                yield finding(fault, fault.message, key=f"{graph.file} {fault.name}")


def _is_named(package: Package, file: str) -> bool:
    """Return whether another available launch file names a file, and may give it arguments."""
    name = posixpath.basename(file)
    stem = name.partition(".")[0]
    others = {id(other): other for other in (package, *package.workspace.packages.values())}
    for other in others.values():
        for path in launch_files(other):
            source = other.read(path)
            same = other is package and path == file
            if not same and isinstance(source, SourceText) and stem in source.text:
                return True
    return False


_USE = """        Node(package='rviz2', executable='rviz2',
             arguments=['-d', LaunchConfiguration('view')]),"""
_DECLARED = "        DeclareLaunchArgument('view', default_value='a.rviz'),"

_AT_THE_END = f"""        RegisterEventHandler(OnProcessExit(on_exit=[
{_USE}
        ])),
{_DECLARED}"""
GOOD = [
    {"@ros2": f"{_DECLARED}\n{_USE}"},
    {"@ros2": _AT_THE_END},
    {"@ros2": _USE.replace("'view'", "'view', default='a.rviz'")},
    {
        "@ros2": _USE,
        "launch/all.launch.xml": '<launch><let name="view" value="a"/>'
        '<include file="$(dirname)/arm.launch.py"/></launch>',
    },
    {
        "@ros2": """        IncludeLaunchDescription(PythonLaunchDescriptionSource(
            [FindPackageShare('nav2_bringup'), '/launch/x.launch.py'])),
"""
        + _USE
    },
]
BAD = [
    {"@ros2": _USE.replace(")]),", ")]),  # ^ LCH007")},
    {"@ros2": f"{_USE.replace(')]),', ')]),  # ^ LCH007')}\n{_DECLARED}"},
]
