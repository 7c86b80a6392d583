"""A launch file starts a program that the build of its package does not install.

The launch ends with "executable 'x' not found on the libexec directory". A program of CMake needs
`add_executable` and `install(TARGETS x DESTINATION lib/${PROJECT_NAME})`; a script in Python
`install(PROGRAMS …)`, or an entry of `console_scripts` in setup.py, and keeps the name of its file:
`x.py` is not `x`. The setup.py of a package that CMake builds counts only with
`ament_python_install_package`. Packages whose build files include other files, or select files by a
pattern, are not checked.

Fix: install the program, or write the name under which it is installed.
Source: ros2launch, `Node`: programs are looked up in `lib/<package>` of the installed package.
"""

from collections.abc import Iterator

from checker.launch.ros2.graph import LaunchGraph, Node, NodeKind, Ros2Launch, is_known
from checker.package.package import Package
from checker.package.programs import why_no_program
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH018", "program-not-installed", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report programs of available packages that their build files do not name."""
    for graph in launch.entries:
        for node in _known_nodes(graph):
            holder = package.named(node.package.value)
            missing = why_no_program(holder, node.executable.value) if holder is not None else ""
            if missing:
                yield finding(
                    node.executable,
                    f"{node.package.value} has no program {node.executable.value!r}: {missing}",
                    severity=None if node.starts is True else Severity.WARNING,
                    key=f"{node.package.value}/{node.executable.value}",
                )


def _known_nodes(graph: LaunchGraph) -> Iterator[Node]:
    """Yield nodes whose package and program are known."""
    for node in graph.nodes:
        named = is_known(node.package.value) and is_known(node.executable.value)
        if named and node.executable.value and node.kind is not NodeKind.COMPONENT:
            yield node


def _node(executable: str, build: str, mark: str = "", package: str = "acme_arm_bringup") -> object:
    return {
        "@ros2": f"        Node(package='{package}', executable='{executable}'),{mark}",
        "@profile": "ros2",
        "CMakeLists.txt": f"project(acme_arm_bringup)\n{build}\nament_package()\n",
    }


_SETUP_PY = """from glob import glob
from setuptools import setup
setup(name='acme_nodes', description='Nodes for an arm.',
      data_files=[('share/acme_nodes/launch', glob('launch/*'))],
      entry_points={'console_scripts': ['watch = acme_nodes.watch:main']})
"""


def _python(executable: str, mark: str = "", scripts: str = "[]") -> object:
    return {
        "@ros2": f"        Node(package='acme_nodes', executable='{executable}'),{mark}",
        "@profile": "ros2",
        "../acme_nodes/package.xml": "<package><name>acme_nodes</name></package>",
        "../acme_nodes/setup.py": _SETUP_PY.replace("entry_", f"scripts={scripts}, entry_"),
    }


_MARK = "  # ^ LCH018"
_TARGET = "add_executable(driver src/a.cpp)\ninstall(TARGETS driver DESTINATION lib/x)"
GOOD = [
    _node("driver", _TARGET),
    _node("watch.py", "install(PROGRAMS scripts/watch.py DESTINATION lib/x)"),
    _node("watch", "file(GLOB scripts scripts/*)\ninstall(PROGRAMS ${scripts} DESTINATION lib/x)"),
    _node("driver", "", package="acme_driver"),
    _node("acme_arm_bringup_node", "add_executable(${PROJECT_NAME}_node a.cpp)"),
    _node("driver", "set(name driver_2)\nadd_executable(${name} a.cpp)"),
    _node("driver", "SET(name driver_2)\nADD_EXECUTABLE(${name} a.cpp)"),
    _python("watch"),
    _python("watcher", scripts="glob('scripts/*')"),
    _python("watcher", scripts="['scripts/watcher']"),
]
BAD = [
    _python("watcher", _MARK),
    _python("watcher", _MARK, scripts="['scripts/watch_all']"),
    _node("drivr", _TARGET, _MARK),
    _node("watch", "install(PROGRAMS scripts/watch.py DESTINATION lib/x)", _MARK),
]
