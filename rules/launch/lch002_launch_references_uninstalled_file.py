"""A launch file names a file that its package does not install.

`ros2 launch` reads the installed package: the file exists in the source, but is not found. Files in
one folder that is not installed are reported once; folders such as config/ and urdf/ are reported
by PKG008. Packages whose CMakeLists.txt or setup.py computes what is installed are not checked.

Fix: add the file or its folder to `install(…)`, to `ament_auto_package(INSTALL_TO_SHARE …)`, or to
`data_files` of setup.py.
Source: ament_cmake user documentation; RobotecAI/ROSCon2023Demo#116.
"""

from collections.abc import Iterator

from checker.formats.xacro.expanded import ExpandedText
from checker.launch.ros2.graph import Ros2Launch, SharePath, share_path
from checker.launch.ros2.named_paths import NamedPath, named_paths
from checker.launch.ros2.package_files import local_file
from checker.package.installed import installed_as, left_out
from checker.package.package import Package
from checker.robots.urdf_files import UrdfFiles
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH002", "launch-references-uninstalled-file", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package, urdf: UrdfFiles | None) -> Findings:
    """Report files in share folders that exist in the source alone."""
    parts = dict(_parts(package, urdf)) if urdf is not None else {}
    named = [named for graph in launch.entries for named in named_paths(graph)]
    for name, path in (
        (each, path) for each in named for path in _with_parts(package, each, parts)
    ):
        holder = package.named(path.package)
        left = left_out(package, holder, path.path) if holder is not None else None
        if left is not None:
            what = f"{path.path}, a part of {name.path}," if path != name.path else str(path)
            yield finding(
                name,
                f"{what} is not installed: {left.instead}",
                severity=None if name.needed else Severity.WARNING,
                key=left.around,
            )


_Parts = dict[str, list[SharePath]]


def _with_parts(package: Package, named: NamedPath, parts: _Parts) -> list[SharePath]:
    """Return a path, and the files that a description there includes."""
    return [named.path, *parts.get(local_file(package, named.path.full_path) or "", ())]


def _parts(package: Package, urdf: UrdfFiles) -> Iterator[tuple[str, list[SharePath]]]:
    """Yield each description with the files that it includes and that nothing installs at all.

    What is installed elsewhere may be found by a relative path: the description is moved too.
    """
    for description in urdf.descriptions:
        source = description.document.source
        parts = source.parts if isinstance(source, ExpandedText) else ()
        paths = [path for part in parts if (path := share_path(part)) is not None]
        yield description.file, [path for path in paths if not _is_installed(package, path)]


def _is_installed(package: Package, path: SharePath) -> bool:
    holder = package.named(path.package)
    return holder is None or bool(installed_as(holder, path.path))


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
_XACRO = """<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find acme_arm_bringup)/parts/hand.xacro"/>
</robot>
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
    {
        "@ros2": """        Node(package='p', executable='e', parameters=[{'robot_description':
            Command(['xacro ', in_package('urdf', 'arm.urdf.xacro')])}]),  # ^ LCH002""",
        "urdf/arm.urdf.xacro": _XACRO,
        "parts/hand.xacro": '<robot><link name="hand"/></robot>',
        "CMakeLists.txt": _AUTO,
    },
    {**_MARKED, "CMakeLists.txt": None, "setup.py": _SETUP},
    {
        "@ros2": f"{_NODE}  # ^ LCH002",
        "CMakeLists.txt": _AUTO.replace("config ", "").replace(
            "ament_auto", "install(DIRECTORY config/ DESTINATION share/${PROJECT_NAME})\nament_auto"
        ),
    },
]
