"""A node of a launch file lacks its executable, or has a keyword that launch does not know.

`node_name`, `node_executable` and `node_namespace` are of releases before Galactic, `type` is of
ROS 1. Without `executable` (in XML and YAML `exec`) the launch file ends with an error. In a file
that is named for one of these releases (`robot_eloquent.launch.py`) this is a warning, and so it is
in a package whose README or Dockerfile names Foxy, which knows the former keywords too, and logs
that they are deprecated. A misspelt keyword, such as `arguements`, ends the launch as well.

Fix: write `name`, `executable` and `namespace`.
Source: launch_ros, `Node`: `executable` is required, and other keywords raise a TypeError; launch,
`ExecuteProcess`, which gets what `Node` does not take.
"""

import re

from checker.finding import Fix
from checker.launch.ros2.actions.nodes import OLD_KEYWORDS, meant_keyword
from checker.launch.ros2.graph import LaunchFaultKind, Ros2Launch
from checker.package.distribution_sign import former_name
from checker.package.package import Package
from checker.rule import Concern, Findings, Safety, Severity, finding, replace_text, rule
from checker.source.text import Span

_RELEASES = re.compile(r"(?<![a-z])(?:ardent|bouncy|crystal|dashing|eloquent|foxy)(?![a-z])")
"""Releases of ROS 2 that know the former keywords."""


@rule("LCH004", "wrong-node-keyword", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report nodes without executable, and keywords that were renamed or misspelt."""
    distro = former_name(package)
    for graph in launch.entries:
        for fault in graph.faults:
            if fault.kind is LaunchFaultKind.ATTRIBUTE:
                new = meant_keyword(fault.name)
                hint = f"; write {new}" if new else f"; add {_executable(fault.span)}"
                release = _RELEASES.search(f"{distro} {fault.span.source.file}")
                is_old = fault.name in OLD_KEYWORDS
                yield finding(
                    fault,
                    f"{fault.message}{hint}",
                    severity=Severity.WARNING if is_old and release is not None else None,
                    key=fault.span.source.file if is_old else fault.message,
                    fix=_renamed(fault.span, fault.name, new) if new else None,
                )


def _renamed(where: Span, old: str, new: str) -> Fix | None:
    """Return the fix that writes another keyword in front of its value."""
    if not where.text.startswith(old):
        return None
    return replace_text(where, where.text.replace(old, new, 1), Safety.UNSAFE)


def _executable(node: Span) -> str:
    """Return the spelling of the keyword in a launch file: Python, or XML and YAML."""
    return "executable" if node.source.file.endswith(".py") else "exec"


GOOD = [{"@ros2": True}]
BAD = [
    {"@ros2": "        Node(package='p', node_executable='e'),  # ^ LCH004"},
    {"@ros2": "        Node(package='p', executable='e', node_name='n'),  # ^ LCH004"},
    {"@ros2": "        Node(package='p', executable='e', arguements=[]),  # ^ LCH004"},
    {
        "@ros2": True,
        "launch/driver_eloquent.launch.py": """from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package='p', node_executable='e')])  # ^ LCH004
""",
    },
    {
        "@ros2": True,
        "launch/view.launch.xml": '<launch>\n<node pkg="p" name="n"/> <!-- ^ LCH004 -->\n</launch>',
    },
]
