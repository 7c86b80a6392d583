"""A parameter file in the command line of a node, in front of `--ros-args`.

ROS 2 reads `--params-file` behind `--ros-args` alone. In front of it, or without it, the two words
are arguments of the program: a node ignores them, and runs with the defaults of all parameters.

It is not reported of a program whose package is available and reads the option itself.

Fix: give the file to `parameters` of the node: `parameters=["arm.yaml"]`; or write `--ros-args` in
front of `--params-file`.
Source: rcl, `rcl_parse_arguments`; ROS 2 design, "ROS command line arguments".
"""

from itertools import takewhile

from checker.launch.ros2.graph import Ros2Launch, display_path
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import SourceText

_START, _OPTION = "--ros-args", "--params-file"
_PROGRAMS = (".py", ".cpp", ".cc", ".hpp", ".h")


@rule("LCH033", "parameter-file-outside-ros-arguments", Severity.WARNING, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report `--params-file` among the words that are not for ROS."""
    for graph in launch.entries:
        for node in graph.nodes:
            own = [*takewhile(lambda word: word.value != _START, node.arguments)]
            at = next((i for i, word in enumerate(own) if word.value == _OPTION), None)
            if at is None or _reads_it(package.named(node.package.value)):
                continue
            file = display_path(own[at + 1].value) if at + 1 < len(own) else "the file"
            yield finding(
                own[at],
                f"{node.executable.value} does not read {file:.150}: {_OPTION} is not behind "
                f"{_START}; expected parameters=[…] of the node",
            )


def _reads_it(holder: Package | None) -> bool:
    """Return whether a program of an available package names the option."""
    files = holder.index.with_suffix(*_PROGRAMS) if holder is not None else ()
    sources = (
        holder.read(file.path)
        for file in files
        if holder is not None and ".launch." not in file.path and "launch/" not in file.path
    )
    return any(isinstance(it, SourceText) and _OPTION in it.text for it in sources)


_NODE = """        Node(package='twist_mux', executable='twist_mux', arguments=[@]),"""


def _given(words: str, mark: str = "") -> dict[str, object]:
    return {"@ros2": f"{_NODE.replace('@', words)}{mark}"}


_FILE = "'--params-file', in_package('config', 'mux.yaml')"
_MARK = "  # ^ LCH033"
_READER = {
    "@ros2": _NODE.replace("'twist_mux'", "'acme_arm_bringup'", 1).replace("@", _FILE),
    "scripts/twist_mux.py": "parser.add_argument('--params-file')\n",
}
GOOD = [_given(f"'--ros-args', {_FILE}"), _given("'--verbose'"), _READER]
BAD = [_given(_FILE, _MARK), _given(f"{_FILE}, '--ros-args', '-r', 'a:=b'", _MARK)]
