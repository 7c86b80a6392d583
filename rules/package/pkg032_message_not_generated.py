"""A node imports a message, service or action that its package in the workspace does not generate.

The import fails, and the node stops as it starts. The file is there and CMakeLists.txt does not
list it, or it has another name, or it was never committed. Packages that put the list together are
not judged, and neither are imports within a function or a `try`.

Fix: list the file in `rosidl_generate_interfaces` (ROS 1: `add_message_files` and its like), or
correct the name in the import.
Source: rosidl_cmake, `rosidl_generate_interfaces`; genmsg, `add_message_files`.
"""

import posixpath
import re
from collections.abc import Iterator

from checker.base.words import Suggestions
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.cmake import CMakeFile, read_cmake
from checker.source.text import Located, SourceText, Span

_IMPORT = re.compile(
    r"^from[ \t]{1,8}([a-z]\w{0,199})\.(msg|srv|action)[ \t]{1,8}import[ \t]{1,8}"
    r"(\([^()]{1,2000}\)|[^#\\\n]{1,500})",
    re.MULTILINE,
)
_NAME = re.compile(r"(?<!as\s)\b[A-Z]\w{0,199}\b")
_COMMANDS = (
    *("rosidl_generate_interfaces", "add_message_files", "add_service_files"),
    "add_action_files",
)


@rule("PKG032", "message-not-generated", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report imports at the top of Python files from packages of the workspace."""
    generated: dict[str, frozenset[str]] = {}
    for name, kind, text in _imports(package):
        holder = package.named(name)
        if name not in generated:
            generated[name] = _generated(holder)
        known = generated[name]
        file = f"{kind}/{text.value}.{kind}"
        if not known or file in known:
            continue
        of_kind = [posixpath.basename(it) for it in sorted(known) if it.startswith(f"{kind}/")]
        there = holder is not None and holder.exists(file)
        hint = "" if there else Suggestions(of_kind).hint(posixpath.basename(file))
        yield finding(
            text,
            f"the import of {text.value} stops the node: CMakeLists.txt of {name} does not "
            f"generate {file}{', which is there' if there else hint}",
            key=file,
        )


def _imports(package: Package) -> Iterator[tuple[str, str, Located[str]]]:
    """Yield package, kind and name of each message that a Python file imports."""
    for file in package.index.with_suffix(".py"):
        source = package.read(file.path)
        if not isinstance(source, SourceText):
            continue
        for found in _IMPORT.finditer(source.text):
            for name in _NAME.finditer(source.text, *found.span(3)):
                yield found[1], found[2], Located(name[0], Span(source, *name.span()))


def _generated(package: Package | None) -> frozenset[str]:
    """Return the files of messages that a package lists; none if it may list others."""
    source = package.read("CMakeLists.txt") if package is not None else None
    if not isinstance(source, SourceText):
        return frozenset()
    build = read_cmake(source)
    words = [word.value for call in build.calls_of(*_COMMANDS) for word in call.arguments[1:]]
    return frozenset() if _is_open(build, words) else frozenset(map(_as_listed, words))


def _is_open(build: CMakeFile, words: list[str]) -> bool:
    computed = any("$" in word for word in words)
    return computed or bool(build.faults) or any(build.calls_of("include", "add_subdirectory"))


def _as_listed(word: str) -> str:
    """Return `msg/Name.msg` of what a build file lists; genmsg lists the name alone."""
    stem, suffix = posixpath.splitext(posixpath.basename(word))
    return f"{suffix[1:]}/{stem}{suffix}"


_LISTED = 'project(acme_words)\nrosidl_generate_interfaces(acme_words\n  "msg/Stop.msg")\n'


def _node(line: str, listed: str = _LISTED) -> dict[str, object]:
    return {
        "@ros2": True,
        "scripts/node.py": f"import rclpy\n{line}\n",
        "../acme_words/package.xml": "<package><name>acme_words</name></package>",
        "../acme_words/CMakeLists.txt": listed,
        "../acme_words/msg/Stop.msg": "bool now\n",
        "../acme_words/msg/Start.msg": "bool now\n",
    }


_MARK = "  # ^ PKG032"
GOOD = [
    _node("from acme_words.msg import Stop"),
    _node("from acme_words.msg import Stop as Start"),
    _node("try:\n    from acme_words.msg import Start\nexcept ImportError:\n    pass"),
    _node("from std_msgs.msg import Strings"),
    _node("from acme_words.msg import Start", _LISTED.replace('"msg', '${FILES} "msg')),
]
BAD = [
    _node(f"from acme_words.msg import Start{_MARK}"),
    _node(f"from acme_words.msg import (\n    Stop,\n    Halt,{_MARK}\n)"),
    _node(
        f"from acme_words.srv import Stop{_MARK}",
        "project(acme_words)\nadd_message_files(FILES Stop.msg)\n",
    ),
]
