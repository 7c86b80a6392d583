"""A node or launch file of a package that the ROS 2 distribution does not have.

The launch ends with "package not found", or "executable not found". Packages of Gazebo Classic are
not in Jazzy and later, those named `ros_ign` became `ros_gz`, and several names are from ROS 1. A
package in the workspace is never reported. It is a warning, because another workspace may build it
from source. Packages for a distribution before Humble, which is not known, are not checked.

Fix: use what the message names, or check for the distribution that the robot runs on (`--distro`).
Source: ros/rosdistro, and the programs that packages install (`removed_packages.json`,
`ros_packages.json`).
"""

from collections.abc import Iterator, Mapping
from typing import Any

from checker.base.resources import table
from checker.launch.ros2.graph import LaunchGraph, Ros2Launch, is_known, share_path
from checker.package.distribution_sign import former_distribution
from checker.package.package import Package
from checker.package.released import ReleasedNames, distributions_with
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked
from checker.source.text import Located


@rule("LCH015", "package-not-in-distribution", Severity.WARNING, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package, context: Context) -> Findings:
    """Report names that are known to be missing in the distribution."""
    former = former_distribution(package)
    released = ReleasedNames(context.distro)
    for graph in launch.entries:
        for name, program in _started_packages(graph):
            if package.workspace.package(name.value) is None and is_known(name.value):
                for key, message in _missing_names(name.value, program, context.distro, released):
                    if former:
                        yield unchecked(f"{name.value}: {former}")
                    else:
                        yield finding(name, message, key=key, covered_by=("LCH008",))


def _missing_names(
    name: str, program: str, distro: str, released: ReleasedNames
) -> Iterator[tuple[str, str]]:
    """Yield what a distribution does not have, the package or its program, and what to write."""
    removed: Mapping[str, Any] = table("removed_packages")["names"]
    key = next((key for key in (name, program) if key in removed), None)
    if key is not None and distro in removed[key]["missing_in"]:
        what, _, executable = key.partition("/")
        shown = f"program {executable!r} in {what!r}" if executable else f"package {what!r}"
        instead = removed[key]["instead"]
        yield key, f"{distro.capitalize()} has no {shown}: expected {instead}"
    elif key is None and not distributions_with(name) and (meant := released.correction_of(name)):
        yield name, f"there is no package {name!r}; did you mean {meant!r}?"


def _started_packages(graph: LaunchGraph) -> Iterator[tuple[Located[str], str]]:
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
    _node("acme_state_publisher", "state_publisher"),
]
BAD = [
    _node("publisher_robot_state", "robot_state_publisher", _MARK),
    _node("robot_state_publsher", "robot_state_publisher", _MARK),
    _node("controller_manager", "spawner.py", _MARK),
    _node("gazebo_ros", "spawn_entity.py", _MARK),
    {
        "@ros2": f"""        IncludeLaunchDescription(PythonLaunchDescriptionSource(
            os.path.join(get_package_share_directory('ros_ign_gazebo'), 'launch', 'x.py'))),{_MARK}
""",
        "@profile": "ros2",
    },
]
