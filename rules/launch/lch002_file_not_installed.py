"""A launch file names a file that its package does not install.

`ros2 launch` reads the installed package: the file exists in the source and is not found. A folder
of which nothing is installed is PKG008's. Packages whose CMakeLists.txt does not say in plain
words what is installed are not judged.

Fix: add the file or its folder to `install(…)`.
Source: ament_cmake user documentation; RobotecAI/ROSCon2023Demo#116.
"""

from checker.expand.ros2_launch.graph import Ros2Launch
from checker.expand.ros2_launch.named_paths import is_left_out, is_whole_folder, named_paths
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH002", "launch-names-uninstalled-file", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report files in share folders that exist in the source alone."""
    for graph in launch.entries:
        for named in named_paths(graph):
            if is_left_out(package, named.path) and not is_whole_folder(package, named.path):
                yield finding(
                    named,
                    f"{named.path} is not installed: the file exists in the source alone",
                    severity=None if named.needed else Severity.WARNING,
                )


_CMAKE = """project(acme_arm_bringup)
find_package(ament_cmake REQUIRED)
install(DIRECTORY launch urdf DESTINATION share/${PROJECT_NAME})
install(DIRECTORY config/arm DESTINATION share/${PROJECT_NAME}/config)
ament_package()
"""
_NODE = """        Node(package='p', executable='e', parameters=[
            in_package('config', 'arm.yaml')]),"""

GOOD = [
    {"@ros2": True},
    {"@ros2": _NODE},
    {"@ros2": _NODE, "CMakeLists.txt": _CMAKE.replace("ament_package", "ament_auto_package")},
]
BAD = [
    {
        "@ros2": f"{_NODE}  # ^ LCH002",
        "CMakeLists.txt": _CMAKE.replace("config/arm DEST", "config/other DEST"),
        "config/other/a.yaml": "a: 1\n",
    },
]
