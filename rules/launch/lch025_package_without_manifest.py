"""A launch file uses a folder that is no package, as it has no package.xml.

colcon finds packages of ROS by their package.xml: a folder without it is neither built nor
installed, and the launch stops with "package not found", whatever else is in the folder.

It is reported if neither the workspace nor a ROS distribution has a package of that name, and the
folder of exactly that name has `urdf/`, `launch/`, `meshes/`, `config/` or `worlds/`. If no launch
starts what uses it by default, it is a warning. A folder with a CMakeLists.txt, setup.py or another
file by which a build may take it is not judged.

Fix: write package.xml, and a CMakeLists.txt that installs the folders; then build again.
Source: colcon, how packages are found: colcon-ros, package identification by package.xml (REP 149);
ament_index_python, `get_package_share_directory`: PackageNotFoundError.
"""

from collections.abc import Iterator

from checker.launch.ros2.graph import Ros2Launch
from checker.launch.ros2.named_paths import named_paths
from checker.launch.ros2.used_packages import used_packages
from checker.package.package import Package
from checker.package.released import distributions_with
from checker.package.workspace import SHARED_FOLDERS
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH025", "package-without-manifest", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report each name once, with all places that use it."""
    needed = {*_needed(launch)}
    for use in used_packages(launch):
        name = use.package_name
        folder = package.workspace.without_manifest(name)
        if folder is None or distributions_with(name) or package.named(name):
            continue
        shared = " ".join(each for each in SHARED_FOLDERS if (folder / each).is_dir())
        yield finding(
            use.place,
            f"the launch stops: the folder {name} has no package.xml, so there is no package "
            f"{name!r}: write package.xml, and CMakeLists.txt with install(DIRECTORY {shared} "
            "DESTINATION share/${PROJECT_NAME})",
            severity=None if name in needed else Severity.WARNING,
            key=name,
        )


def _needed(launch: Ros2Launch) -> Iterator[str]:
    """Yield the packages without which nothing starts, or not all that starts by default."""
    for graph in launch.entries:
        yield from (named.path.package for named in named_paths(graph) if named.needed)
        yield from (node.package.value for node in graph.nodes if node.starts is True)


_OPENED = """        Node(package='robot_state_publisher', executable='robot_state_publisher',
             parameters=[{'robot_description': open(os.path.join(
                get_package_share_directory('@'), 'urdf', 'arm.urdf')).read()}]),%
"""
_ROBOT = '<robot name="arm"><link name="base"/></robot>'
_LIKE_PACKAGE = "<package><name>acme_hand</name></package>"


def _opens(name: str, mark: str = "", **more: str) -> dict[str, object]:
    return {
        "@ros2": _OPENED.replace("@", name).replace("%", mark),
        "../acme_hand/urdf/arm.urdf": _ROBOT,
        **{f"../acme_hand/{file.replace('__', '.')}": text for file, text in more.items()},
    }


_MARK = "  # ^ LCH025"
GOOD = [
    _opens("acme_arm_bringup"),
    _opens("acme_other_arm"),
    _opens("acme_hand", package__xml=_LIKE_PACKAGE),
    _opens("acme_hand", CMakeLists__txt="project(acme_hand)"),
    _opens("acme_hand", COLCON_IGNORE=""),
]
BAD = [_opens("acme_hand", _MARK)]
