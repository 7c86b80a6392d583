"""A program of the package names a file by its path on the machine of its author.

On every other machine the node stops there, or works without the file. A path in a home, such as
`/home/me/ws/src/arm/urdf/arm.urdf`, on a drive of Windows, or in the folders of a workspace is
reported in programs in Python and C++ that the build names, and in headers. The default of a
parameter or of a command line, which a launch file may replace, is an info. Comments, tests and
launch files are left out, and paths of a container; WIR014 reports launch files.

Fix: install the file with the package, and find it there:
`get_package_share_directory("arm") + "/urdf/arm.urdf"`, in C++
`ament_index_cpp::get_package_share_directory("arm")`; or take the path as a parameter.
Source: ament_index; a path in a home is on one machine.
"""

import posixpath
import re
from collections.abc import Iterator

from checker.package.containers import container_with
from checker.package.package import Package
from checker.package.uris import is_on_one_machine, own_path_on_machine
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import Located, SourceText, Span

_SOURCES = (".py", ".cpp", ".cc", ".cxx")
_HEADERS = (".hpp", ".h")
_BUILD_FILES = ("setup.py", "CMakeLists.txt")
_TEXT = re.compile(r"""(["'])((?:/|[A-Za-z]:[/\\])[^"'\n]{1,300}\.[A-Za-z]\w{1,9})\1""")
_WORD = re.compile(r"\w{1,200}")
_COMMENT = re.compile(r"#|//|\*")
_DEFAULT = re.compile(r"declare_parameter|get_param|add_argument|\bparam\s{0,4}[(<]|environ|getenv")


@rule("WIR035", "program-names-path-of-one-machine", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report files of one machine that programs name."""
    for source in _programs(package):
        for path, line in _paths(source):
            if container_with(package, path.value):
                continue
            own = own_path_on_machine(package, path.value)
            cure = f"find {own} in the share folder of {package.declared_name}" if own else ""
            yield finding(
                path,
                f"the program names {path.value}, on its author's machine, and is found on no "
                f"other: {cure or 'install the file with a package, or take it as a parameter'}",
                severity=Severity.INFO if _DEFAULT.search(line) else None,
                key=path.value,
            )


def _programs(package: Package) -> Iterator[SourceText]:
    """Yield the programs that the build names, and headers."""
    builds = (package.read(name) for name in _BUILD_FILES if package.exists(name))
    texts = (it.text for it in builds if isinstance(it, SourceText))
    words = {word for text in texts for word in _WORD.findall(text)}
    others = {*_BUILD_FILES, *package.launch_texts}
    for file in package.index.with_suffix(*_SOURCES, *_HEADERS) if words else ():
        stem = posixpath.splitext(posixpath.basename(file.path))[0]
        is_named = file.path.endswith(_HEADERS) or stem in words
        is_other = file.is_of_tests or file.path in others
        source = package.read(file.path) if is_named and not is_other else None
        if isinstance(source, SourceText):
            yield source


def _paths(source: SourceText) -> Iterator[tuple[Located[str], str]]:
    """Yield the paths on one machine that are no comment, each with its line."""
    for found in _TEXT.finditer(source.text):
        start = source.text.rfind("\n", 0, found.start()) + 1
        line = source.text[start : found.end()]
        before = source.text[start : found.start()]
        if is_on_one_machine(found[2]) and not _COMMENT.search(before):
            yield Located(found[2], Span(source, *found.span(2))), line


def _node(line: str, setup: str = "arm = acme_arm_description.arm:main") -> dict[str, object]:
    return {
        "@ros2": True,
        "setup.py": f'from setuptools import setup\nsetup(entry_points={{"console_scripts": '
        f'["{setup}"]}})\n',
        "acme_arm_description/arm.py": f"import os\n\n{line}\n",
    }


_MARK = "  # ^ WIR035"
_URDF = "/home/ann/ws/src/acme_arm_description/urdf/arm.urdf"
GOOD = [
    _node("path = os.path.join('urdf', 'arm.urdf')"),
    _node(f"# path = '{_URDF}'"),
    _node(f"path = '{_URDF}'", "other = acme_arm_description.other:main"),
    _node("path = '/dev/video.raw'"),
]
BAD = [
    _node(f"path = '{_URDF}'{_MARK}"),
    _node(f'model = load("/home/ann/models/best.pt"){_MARK}'),
    _node(f'node.declare_parameter("model", "/home/ann/models/best.pt"){_MARK}'),
    {
        "@ros2": True,
        "CMakeLists.txt": "project(acme_arm_description)\nadd_executable(arm src/arm.cpp)\n"
        "ament_package()\n",
        "src/arm.cpp": f'auto path = "{_URDF}";  // ^ WIR035\n',
    },
]
