"""A node or launch file of a package that the ROS 2 distribution does not have.

The launch ends with "package not found", or "executable not found". Packages of Gazebo Classic are
not in Jazzy and later, those named `ros_ign` became `ros_gz`, and several names are from ROS 1. A
package in the workspace is never reported. It is a warning, since a build from source elsewhere may
have it.

Fix: use what the message names, or check for the distribution that the robot runs on (`--distro`).
Source: ros/rosdistro, and the programs that packages install (`removed_packages.json`).
"""

from collections.abc import Iterator, Mapping
from typing import Any

from checker.base.resources import table
from checker.expand.ros2_launch.graph import LaunchGraph, Ros2Launch, share_path
from checker.package.package import Package
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.source.text import Located


@rule("LCH015", "package-not-in-distribution", Severity.WARNING, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package, context: Context) -> Findings:
    """Report names that are known to be missing in the distribution."""
    known: Mapping[str, Any] = table("removed_packages")["names"]
    for graph in launch.entries:
        for name, program in _started(graph):
            removed = next((key for key in (name.value, program) if key in known), None)
            if removed is None or context.distro not in known[removed]["missing_in"]:
                continue
            if package.workspace.package(name.value) is None:
                what, _, executable = removed.partition("/")
                shown = f"program {executable!r} in {what!r}" if executable else f"package {what!r}"
                yield finding(
                    name,
                    f"{context.distro.capitalize()} has no {shown}: expected "
                    f"{known[removed]['instead']}",
                    key=removed,
                    covered_by=("LCH008",),
                )


def _started(graph: LaunchGraph) -> Iterator[tuple[Located[str], str]]:
    """Yield packages that are needed by default, each with its program."""
    for node in graph.nodes:
        if node.starts is True:
            yield node.package, f"{node.package.value}/{node.executable.value}"
    for include in graph.includes:
        target = share_path(include.target.value)
        if target is not None and include.starts is True:
            yield Located(target.package, include.target.span), ""


def _node(package: str, executable: str, mark: str = "") -> object:
    return {
        "@ros2": f"        Node(package='{package}', executable='{executable}'),{mark}",
        "@profile": "ros2",
    }


_MARK = "  # ^ LCH015"
GOOD = [
    _node("ros_gz_sim", "create"),
    _node("acme_driver", "amcl"),
    _node("controller_manager", "spawner"),
]
BAD = [
    _node("controller_manager", "spawner.py", _MARK),
    _node("gazebo_ros", "spawn_entity.py", _MARK),
    {
        "@ros2": f"""        IncludeLaunchDescription(PythonLaunchDescriptionSource(
            os.path.join(get_package_share_directory('ros_ign_gazebo'), 'launch', 'x.py'))),{_MARK}
""",
        "@profile": "ros2",
    },
]
