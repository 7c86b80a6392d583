"""A launch file names a file that its package does not install.

`ros2 launch` reads the installed package: the file exists in the source and is not found. What lies
in one folder of which nothing is installed is reported once; folders such as config/ and urdf/ are
PKG008's. Packages are judged whose CMakeLists.txt or setup.py says in plain words what is
installed.

Fix: add the file or its folder to `install(…)`, to `ament_auto_package(INSTALL_TO_SHARE …)`, or to
`data_files` of setup.py.
Source: ament_cmake user documentation; RobotecAI/ROSCon2023Demo#116.
"""

from checker.expand.ros2_launch.graph import Ros2Launch
from checker.expand.ros2_launch.named_paths import named_paths
from checker.expand.ros2_launch.package_files import holder_of
from checker.package.installed import left_out
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH002", "launch-names-uninstalled-file", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report files in share folders that exist in the source alone."""
    for graph in launch.entries:
        for named in named_paths(graph):
            holder = holder_of(package, named.path.package)
            left = left_out(package, holder, named.path.path) if holder is not None else None
            if left is not None:
                yield finding(
                    named,
                    f"{named.path} is not installed: {left.instead}",
                    severity=None if named.needed else Severity.WARNING,
                    key=left.around,
                )


_CMAKE = """project(acme_arm_bringup)
find_package(ament_cmake REQUIRED)
install(DIRECTORY launch urdf DESTINATION share/${PROJECT_NAME})
install(DIRECTORY config/arm DESTINATION share/${PROJECT_NAME}/config)
ament_package()
"""
_AUTO = """project(acme_arm_bringup)
find_package(ament_cmake_auto REQUIRED)
ament_auto_package(INSTALL_TO_SHARE config launch urdf)
"""
_SETUP = """from glob import glob
from setuptools import setup
setup(name="acme_arm_bringup", data_files=[
    ("share/acme_arm_bringup", ["package.xml"]),
    ("share/acme_arm_bringup/launch", glob("launch/*")),
    ("share/acme_arm_bringup/urdf", glob("urdf/*")),
    ("share/acme_arm_bringup/config", glob("config/*")),
])
"""
_NODE = """        Node(package='p', executable='e', parameters=[
            in_package('config', 'arm.yaml')]),"""
_TWO = """        Node(package='p', executable='e', parameters=[
            in_package('maps', 'hall.yaml'), in_package('maps', 'yard.yaml')]),"""
_MAPS = {"@ros2": _TWO, "maps/hall.yaml": "a: 1\n", "maps/yard.yaml": "a: 1\n"}
_MARKED = {**_MAPS, "@ros2": f"{_TWO}  # ^ LCH002"}

GOOD = [
    {"@ros2": True},
    {"@ros2": _NODE},
    {**_MAPS, "CMakeLists.txt": _AUTO.replace("launch", "launch maps")},
    {**_MAPS, "CMakeLists.txt": f"include(install.cmake)\n{_AUTO}"},
    {**_MAPS, "CMakeLists.txt": None, "setup.py": _SETUP.replace("config", "maps")},
    {"@ros2": _NODE, "CMakeLists.txt": _AUTO.replace("config ", "")},
]
BAD = [
    {
        "@ros2": f"{_NODE}  # ^ LCH002",
        "CMakeLists.txt": _CMAKE.replace("config/arm DEST", "config/other DEST"),
        "config/other/a.yaml": "a: 1\n",
    },
    {**_MARKED, "CMakeLists.txt": _AUTO},
    {**_MARKED, "CMakeLists.txt": None, "setup.py": _SETUP},
    {
        "@ros2": f"{_NODE}  # ^ LCH002",
        "CMakeLists.txt": _AUTO.replace("config ", "").replace(
            "ament_auto", "install(DIRECTORY config/ DESTINATION share/${PROJECT_NAME})\nament_auto"
        ),
    },
]
