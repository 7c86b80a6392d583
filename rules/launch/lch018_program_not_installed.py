"""A launch file starts a program that the build of its package does not install.

The launch ends with "executable 'x' not found on the libexec directory". A program of CMake needs
`add_executable` and `install(TARGETS x DESTINATION lib/${PROJECT_NAME})`; a script in Python
`install(PROGRAMS …)`, or an entry of `console_scripts` in setup.py, and keeps the name of its file:
`x.py` is not `x`. Packages whose build files include other files, or select files by a pattern, are
not checked.

Fix: install the program, or write the name under which it is installed.
Source: ros2launch, `Node`: programs are looked up in `lib/<package>` of the installed package.
"""

import re
from collections.abc import Iterator

from checker.launch.ros2.graph import LaunchGraph, Node, NodeKind, Ros2Launch, is_known
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import SourceText

_WORD = re.compile(r"[\w.-]+")
_CMAKE = re.compile(
    r"\bGLOB\b|\badd_subdirectory\b|\binclude\s{0,8}\(|\bforeach\b|\bExternalProject"
    r"|\bFetchContent|\b(?:add_executable|\w*register_node\w*|install)\s{0,8}\([^)]{0,5000}\$\{",
    re.IGNORECASE,
)
"""Among others a call with a variable, next to the name of the project."""
_PROJECT = re.compile(r"\$\{PROJECT_NAME\}|\$\{CMAKE_PROJECT_NAME\}")
_SETUP = re.compile(
    r"[\"']lib/|\bf[\"']|\.format\(|[\"']\s{0,8}%"
    r"|\bfor\s[\w\s,()]{1,60}\sin\b|\bscripts\s{0,8}=\s{0,8}[^\s\[=]"
)
"""Among others names that are put together, and scripts that are not listed."""
_NOT_PLAIN = {
    "CMakeLists.txt": _CMAKE,
    "setup.py": _SETUP,
    "setup.cfg": None,
    "pyproject.toml": None,
}
"""Build files, and what in them may install programs whose names they do not state."""


@rule("LCH018", "program-not-installed", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report programs of available packages that their build files do not name."""
    for graph in launch.entries:
        for node in _known_nodes(graph):
            holder = package.workspace.package(node.package.value)
            build = _build_file(holder) if holder is not None else None
            missing = _missing(node.executable.value, build) if build is not None else ""
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


def _build_file(holder: Package) -> SourceText | None:
    """Return the file that states what is installed; None if it does not state all."""
    sources = []
    for name, not_plain in _NOT_PLAIN.items():
        source = holder.read(name) if holder.exists(name) else None
        if isinstance(source, SourceText):
            plain = _PROJECT.sub(holder.declared_name, source.text)
            if not_plain is not None and not_plain.search(plain):
                return None
            sources.append(SourceText(name, plain))
    text = "\n".join(source.text for source in sources)
    return SourceText(sources[0].file, text) if sources else None


def _missing(program: str, build: SourceText) -> str:
    """Return why a build file does not install a program; empty if it may."""
    words = set(_WORD.findall(build.text))
    if program in words:
        return ""
    if f"{program}.py" in words:
        return f"{build.file} installs {program}.py, with the file extension"
    return f"nothing in {build.file} builds or installs it"


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
