"""A launch file, the arguments passed to it, and the robots that it loads."""

from __future__ import annotations

import posixpath
import re
import shlex
from collections.abc import Iterator, Mapping
from itertools import pairwise
from types import MappingProxyType
from typing import Protocol

from checker.base.record import Record
from checker.formats.xacro.files import ROOT
from checker.launch.ros1.attributes import Reader, truth_of
from checker.launch.ros1.graph import LaunchGraph, UnresolvedInclude
from checker.launch.ros1.scope import HERE, Scope
from checker.launch.ros1.substitution import is_known
from checker.source.text import Located, Span
from checker.source.xml import Element, XmlDocument

# What launch files load as `robot_description`: which file, and with which arguments.


_FIND = re.compile(r"\$\(find\s{1,8}([\w.-]{1,200})\s{0,8}\)")
_SUFFIXES = (".urdf", ".xacro", ".xml")
_COMMAND_LIMIT = 4_000
"""Characters of a command that is read."""


class Load(Record):
    """A file that a launch file loads.

    Attributes:
        path: The path as xacro sees it.
        args: Arguments that xacro is given.
        by_xacro: Whether xacro reads it; otherwise it is loaded as it is.
        unknown: Names of arguments whose values are only known at launch.
        as_it_is: Whether it is known that the text of the file is loaded, and nothing else.
    """

    path: str
    args: Mapping[str, str]
    by_xacro: bool
    unknown: tuple[str, ...] = ()
    as_it_is: bool = False


def loads(graph: LaunchGraph) -> Iterator[Load]:
    """Yield what a launch file loads into parameters, or passes to a node with `-file`."""
    for param in graph.params:
        if param.kind == "command":
            yield from read_command(param.value)
        elif param.kind == "textfile":
            yield from _plain(param.value)
    for node in graph.nodes:
        words = _words(node.args)
        for option, value in pairwise(words):
            if option == "-file":
                yield from _plain(value)


def read_command(command: str) -> Iterator[Load]:
    """Yield the file that a command prints: `xacro FILE arg:=value`, or `cat FILE`."""
    program, *words = _words(command) or [""]
    file = next((word for word in words if _is_description(word)), None)
    if file is None:
        return
    pairs = (word.partition(":=") for word in words)
    given = {name: value for name, assigned, value in pairs if assigned}
    args = {name: value for name, value in given.items() if is_known(value)}
    tools = {_name_of(word) for word in (program, *words)}
    unknown = tuple(name for name in given if name not in args)
    yield Load(file, args, "xacro" in tools, unknown, _name_of(program) == "cat")


def _name_of(program: str) -> str:
    return program.rpartition("/")[2].removesuffix(".py")


def _plain(text: str) -> Iterator[Load]:
    file = _placed(text.strip())
    if _is_description(file):
        yield Load(file, {}, by_xacro=False, as_it_is=True)


def _is_description(word: str) -> bool:
    return word.startswith(f"{ROOT}/") and word.lower().endswith(_SUFFIXES)


def _words(command: str) -> list[str]:
    try:
        return shlex.split(_placed(command[:_COMMAND_LIMIT]))
    except ValueError:  # a quotation mark that nothing closes
        return []


def _placed(text: str) -> str:
    return _FIND.sub(lambda match: f"{ROOT}/{match[1]}", text)


# The command line that starts a launch file, as a spawner writes it.


class LaunchCommand(Record):
    """`roslaunch --wait P vehicle_topics.launch world_name:=w name:=n`, taken apart.

    Attributes:
        package: The package; empty if the launch file is named by its path.
        file: Name or path of the launch file; empty if the command names none.
        arguments: Args by name; the last one counts.
        options: Words that start with a hyphen.
        leftover: Words that fit nowhere.
    """

    package: str
    file: str
    arguments: Mapping[str, str]
    options: tuple[str, ...] = ()
    leftover: tuple[str, ...] = ()

    @classmethod
    def parse(cls, command: str) -> LaunchCommand | None:
        """Read a command line; None if it does not call roslaunch."""
        program, *words = command.split() or [""]
        if program.rsplit("/", 1)[-1] != "roslaunch":
            return None
        arguments: dict[str, str] = {}
        options, names = [], []
        for word in words:
            name, assigned, value = word.partition(":=")
            if assigned and name:
                arguments[name] = value
            elif word.startswith("-"):
                options.append(word)
            else:
                names.append(word)
        package, file, leftover = _package_and_file(names)
        return cls(package, file, arguments, tuple(options), tuple(leftover))


def _package_and_file(names: list[str]) -> tuple[str, str, list[str]]:
    if names and names[0].endswith((".launch", ".xml")):
        return "", names[0], names[1:]
    if len(names) >= 2:
        return names[0], names[1], names[2:]
    return "", "", names


_FOUND = re.compile(r"\$\(find\s+([^\s()]+)\s*\)/*(.*)\Z", re.DOTALL)


class MissingLaunchFile(str):
    """The reason of a resolver that has the package, but no such file in it."""

    __slots__ = ()


class ReadLaunch(Protocol):
    """Finds an included launch file."""

    def __call__(self, package: str, path: str, from_file: str) -> XmlDocument | str:
        """Return the document, or the reason why it is not available.

        A reason that is a `MissingLaunchFile` makes a fault of it. The same file should be
        returned as the same document, so that it is parsed once.

        Args:
            package: Package that contains the file; empty when `path` starts where `from_file`
                does, at the package's folder.
            path: Path of the file, without `.` and `//`; it may start with `..`.
            from_file: The including file (`SourceText.file`).
        """
        ...


class Inclusion(Record, eq=False):
    """An `<include>` as written, substitutions made.

    Attributes:
        package: Package of `$(find …)`, else empty.
        path: Path within the package; empty if it is not known before the launch.
        file: The `file` attribute.
        arguments: All passed arguments.
        argument_places: The `<arg>` elements below it, by name.
        passes_all: Whether `pass_all_args` is set.
        span: The start tag.
    """

    package: str
    path: str
    file: Located[str]
    arguments: MappingProxyType[str, str]
    argument_places: Mapping[str, Span]
    passes_all: bool
    span: Span

    def unresolved(self, namespace: str, reason: str) -> UnresolvedInclude:
        """Return the record of a file that is not available."""
        path = self.path or self.file.value
        arguments = self.arguments
        return UnresolvedInclude(self.package, path, arguments, namespace, str(reason), self.span)


def read_inclusion(reader: Reader, element: Element, scope: Scope) -> Inclusion:
    """Read an `<include>`."""
    file = reader.text(element, "file", scope) or Located("", element.span, stated=False)
    passes_all = truth_of(reader.value(element, "pass_all_args", scope)) or False
    arguments = dict(scope.args) if passes_all else {}
    places: dict[str, Span] = {}
    for child in element.all("arg"):
        if not reader.is_enabled(child, scope):
            continue
        value = reader.text(child, "value", scope) or reader.text(child, "default", scope)
        if value is not None:
            name = child.get("name") or ""
            arguments[name], places[name] = value.value, child.span
    package, path = target_of(file.value)
    given_arguments = MappingProxyType(arguments)
    return Inclusion(package, path, file, given_arguments, places, passes_all, element.span)


def target_of(file: str) -> tuple[str, str]:
    """Return package and path of an included file; an empty path when they are not known."""
    match = _FOUND.match(file)
    if match:
        package, path = match.groups()
    elif file.startswith(HERE):
        package, path = "", file
    else:
        return "", ""
    return package, posixpath.normpath(path) if path and is_known(path) else ""
