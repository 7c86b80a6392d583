"""CMakeLists.txt generates messages from a file that is not in the package.

The configure step stops at it, so nothing of the package is built, and the launch files find no
package. The file was never committed, or it has another name or folder.

Fix: add the file to the repository, or remove its name from CMakeLists.txt.
Source: genmsg, `add_message_files`; rosidl_cmake, `rosidl_generate_interfaces`: both stop with an
error where a file does not exist.
"""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from itertools import takewhile

from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.cmake_calls import Call
from checker.source.text import Located

_FOLDERS = {"add_message_files": "msg", "add_service_files": "srv", "add_action_files": "action"}
"""Commands of genmsg, and the folder of each where it names none."""
_INTERFACES = "rosidl_generate_interfaces"
_KEYWORDS = frozenset(
    {
        *("DIRECTORY", "PACKAGE", "NOINSTALL", "DEPENDENCIES", "LIBRARY_NAME", "SKIP_INSTALL"),
        *("SKIP_GROUP_MEMBERSHIP_CHECK", "ADD_LINTER_TESTS"),
    }
)
_SUFFIXES = (".msg", ".srv", ".action", ".idl")
_MAKING = ("configure_file", "file", "add_custom_command", "execute_process")
"""Commands that may make a file."""


@rule("PKG030", "message-file-not-found", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, paperwork: Paperwork) -> Findings:
    """Report files of messages, services and actions that do not exist."""
    build = paperwork.build
    if build is None:
        return
    made = {word.value for call in build.calls_of(*_MAKING) for word in call.arguments}
    for call in build.calls_of(*_FOLDERS, _INTERFACES):
        for word, path in _files(call):
            name = posixpath.basename(path)
            if package.exists(path) or any(name in each for each in made):
                continue
            yield finding(
                word,
                f"nothing of the package is built: {call.name} names {path}, which does not exist",
                severity=Severity.WARNING if call.conditional else None,
                key=call.name,
            )


def _files(call: Call) -> Iterator[tuple[Located[str], str]]:
    """Yield the files that a call names, each with its path in the package."""
    words = [word.value for word in call.arguments]
    at, folder = 1, ""
    if call.name != _INTERFACES:
        at = words.index("FILES") + 1 if "FILES" in words else len(words)
        folder = _FOLDERS[call.name]
        if "DIRECTORY" in words[:-1]:
            folder = words[words.index("DIRECTORY") + 1]
    for word in takewhile(lambda word: word.value not in _KEYWORDS, call.arguments[at:]):
        path = posixpath.normpath(posixpath.join(folder, word.value))
        # An absolute path is of another folder; `folder:msg/Name.msg` is so too.
        is_known = not path.startswith(("/", "..")) and "$" not in path and ":" not in path
        if is_known and path.endswith(_SUFFIXES):
            yield word, path


_ROS_2 = "project(rover)\nrosidl_generate_interfaces(rover\n  {}\n  DEPENDENCIES std_msgs)\n"
_ROS_1 = "project(rover)\nadd_message_files({}\n  FILES\n  Speed.msg\n)\n"


def _package(cmake: str, *files: str, mark: str = "") -> dict[str, object]:
    text = cmake.replace(".msg", f".msg{mark}", 1)
    return {"@ros2": True, "CMakeLists.txt": text, **dict.fromkeys(files, "float64 speed\n")}


_MARK = "  # ^ PKG030"
_NAMED = _ROS_2.format("msg/Speed.msg")
GOOD = [
    _package(_NAMED, "msg/Speed.msg"),
    _package(_ROS_1.format(""), "msg/Speed.msg"),
    _package(_ROS_1.format(" DIRECTORY types"), "types/Speed.msg"),
    _package(f"configure_file(a.in msg/Speed.msg)\n{_NAMED}"),
]
BAD = [
    _package(_NAMED, mark=_MARK),
    _package(_ROS_1.format(""), "msg/Other.msg", mark=_MARK),
    _package(_ROS_1.format(" DIRECTORY types"), "msg/Speed.msg", mark=_MARK),
]
