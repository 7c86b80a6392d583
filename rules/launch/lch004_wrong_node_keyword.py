"""A node of a launch file lacks a keyword that it needs, or has one that launch does not know.

`node_name`, `node_executable`, `node_namespace` and `node_plugin` are of releases before Galactic,
`type` is of ROS 1. Without `executable` (in XML and YAML `exec`) the launch file ends with an
error; so it does where a LifecycleNode or a ComposableNodeContainer lacks `name` or `namespace`,
or a ComposableNode `package` or `plugin`. In a file that is named for one of these releases
(`robot_eloquent.launch.py`) a former keyword and a missing namespace are warnings, and so they are
in a package whose README or Dockerfile names Foxy, which knows the former keywords too, and logs
that they are deprecated. A misspelt keyword, such as `arguements`, ends the launch as well.

Fix: write `name`, `executable`, `namespace` and `plugin`; an empty `namespace=''` will do.
Source: launch_ros, `Node`, `LifecycleNode`, `ComposableNodeContainer` and `ComposableNode`: these
are required, and other keywords raise a TypeError; launch, `ExecuteProcess`, which gets what `Node`
does not take.
"""

import re

from checker.finding import Fix
from checker.launch.ros2.actions.nodes import OLD_KEYWORDS, meant_keyword
from checker.launch.ros2.graph import LaunchFault, LaunchFaultKind, Ros2Launch
from checker.package.distribution_sign import former_name
from checker.package.package import Package
from checker.rule import Concern, Findings, Safety, Severity, finding, replace_text, rule
from checker.source.text import Span

_RELEASES = re.compile(r"(?<![a-z])(?:ardent|bouncy|crystal|dashing|eloquent|foxy)(?![a-z])")
"""Releases of ROS 2 that know the former keywords."""
_FORMERLY_OPTIONAL = "namespace"
_IN_MARKUP = {"executable": "exec", "package": "pkg"}
"""Keywords that XML and YAML spell otherwise."""


@rule("LCH004", "wrong-node-keyword", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report nodes without a required keyword, and keywords that were renamed or misspelt."""
    distro = former_name(package)
    for graph in launch.entries:
        for fault in graph.faults:
            if fault.kind is LaunchFaultKind.ATTRIBUTE:
                new = meant_keyword(fault.name)
                lacking = f", so the launch file stops here: add {_spelling(fault)}"
                hint = f"; write {new}" if new else lacking
                release = _RELEASES.search(f"{distro} {fault.span.source.file}")
                is_old = fault.name in OLD_KEYWORDS
                works = is_old or fault.name == _FORMERLY_OPTIONAL
                yield finding(
                    fault,
                    f"{fault.message}{hint}",
                    severity=Severity.WARNING if works and release is not None else None,
                    key=fault.span.source.file if is_old else fault.message,
                    fix=_renamed(fault.span, fault.name, new) if new else None,
                )


def _renamed(where: Span, old: str, new: str) -> Fix | None:
    """Return the fix that writes another keyword in front of its value."""
    if not where.text.startswith(old):
        return None
    return replace_text(where, where.text.replace(old, new, 1), Safety.UNSAFE)


def _spelling(fault: LaunchFault) -> str:
    """Return the spelling of a keyword in a launch file: Python, or XML and YAML."""
    is_python = fault.span.source.file.endswith(".py")
    return fault.name if is_python else _IN_MARKUP.get(fault.name, fault.name)


_FILE = """from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer, LifecycleNode, Node
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    return LaunchDescription([
        @
    ])
"""
_MARK = "  # ^ LCH004"


def _launch(entity: str, name: str = "lens") -> dict[str, str | bool]:
    return {"@ros2": True, f"launch/{name}.launch.py": _FILE.replace("@", entity)}


def _lifecycle(keywords: str, mark: str = "") -> str:
    return f"LifecycleNode(package='p', executable='e', {keywords}),{mark}"


def _container(component: str, keywords: str = "name='box', namespace=''", mark: str = "") -> str:
    return f"""ComposableNodeContainer({mark}
            package='p', executable='e', {keywords}, composable_node_descriptions=[
                ComposableNode(package='p', {component}])"""


GOOD = [
    {"@ros2": True},
    _launch(_lifecycle("name='map', namespace=''")),
    _launch(_lifecycle("**{'name': 'map', 'namespace': ''}")),
    _launch(_lifecycle("**keywords_of('map')")),
    _launch(_container("plugin='eye::Lens', extra_arguments=[])")),
]
BAD = [
    {"@ros2": "        Node(package='p', node_executable='e'),  # ^ LCH004"},
    {"@ros2": "        Node(package='p', executable='e', node_name='n'),  # ^ LCH004"},
    {"@ros2": "        Node(package='p', executable='e', arguements=[]),  # ^ LCH004"},
    _launch(f"Node(package='p', node_executable='e'){_MARK}", "driver_eloquent"),
    _launch(_lifecycle("name='map'", _MARK)),
    _launch(_lifecycle("namespace=''", _MARK)),
    _launch(_container("plugin='eye::Lens')", "name='box'", _MARK)),
    _launch(_container(f"name='lens'){_MARK}\n                ")),
    _launch(_container(f"node_plugin='eye::Lens'){_MARK}\n                ")),
    {
        "@ros2": True,
        "launch/view.launch.xml": '<launch>\n<node pkg="p" name="n"/> <!-- ^ LCH004 -->\n</launch>',
    },
]
