"""Reads a launch file, in any of its languages, with all that it includes."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from typing import TypeVar

from msgspec.structs import replace

from checker.base.resources import table
from checker.launch.ros2 import package_files
from checker.launch.ros2.actions.gathered import FileRead, Gathered
from checker.launch.ros2.actions.visitor import Visitor
from checker.launch.ros2.context import Context, State
from checker.launch.ros2.graph import (
    FileUse,
    LaunchFault,
    LaunchFaultKind,
    LaunchGraph,
    Unread,
    share_path,
)
from checker.launch.ros2.markup import read_markup
from checker.launch.ros2.python.interpreter import Interpreter
from checker.launch.ros2.python.launch_file import (
    expression,
    function_call,
    module_of,
    read_python,
)
from checker.launch.ros2.python.scope import Scope
from checker.launch.ros2.substitutions import NOT_DECLARED, perform
from checker.launch.ros2.values import (
    Allowance,
    LaunchLimit,
    PlacedText,
    Unknown,
    Value,
)
from checker.package.detected_target import detect_target
from checker.package.files_above import README, files_around
from checker.package.package import Package
from checker.source.text import Located, SourceText, Span

_Item = TypeVar("_Item", LaunchFault, Unread)

_EXPORT = re.compile(r"""\bexport[ \t]+([A-Z]\w{1,80})=["']?([\w.-]{1,80})(?=["'`\s]|\Z)""")
"""`export LDS_MODEL=LDS-02`, as a README tells users to write."""
FILES_LIMIT = 60
"""Launch files and modules that one launch file may include."""


def read_launch(
    package: Package, file: str, arguments: Mapping[str, str] | None = None
) -> LaunchGraph:
    """Read a launch file.

    Args:
        package: The package being checked.
        file: The file as the package lists it.
        arguments: The arguments of the command line.
    """
    return LaunchReader(package, file, arguments or {}).graph()


class LaunchReader:
    """The reading of one launch file; it is the world of the file, see `World` and `Files`."""

    def __init__(self, package: Package, file: str, arguments: Mapping[str, str]) -> None:
        """Begin."""
        self._package = package
        self._file = file
        self._arguments = arguments
        self._allowance = Allowance()
        self._found = Gathered()
        self._visitor = Visitor(self._found, self)
        self._modules: dict[str, Scope | None] = {}
        self._context: Context | None = None
        self._read = 0
        self._uses: list[FileUse] = []

    def graph(self) -> LaunchGraph:
        """Return what the file starts."""
        source = self._package.read(self._file)
        if not isinstance(source, SourceText):
            empty = SourceText(self._file, "").whole()
            return LaunchGraph(self._file, unread=(Unread(str(source.reason), empty),))
        given = {name: PlacedText(text, source.whole()) for name, text in self._arguments.items()}
        variables = {
            name: PlacedText(value, source.whole()) for name, value in self._variables.items()
        }
        state = State(configurations=dict(given), environment=dict(variables))
        context = self._context_of(source, state)
        try:
            self._visit_file(source, context)
            self._visitor.finish()
        except LaunchLimit as limit:
            self._limit(source, str(limit))
        except RecursionError:
            self._limit(source, "is nested too deeply")
        return self._graph(context)

    def _limit(self, source: SourceText, message: str) -> None:
        fault = LaunchFault(LaunchFaultKind.LIMIT, source.whole(), f"the launch file {message}")
        self._found.faults.append(fault)
        self._visitor.unread(message, source.whole())

    def _graph(self, context: Context) -> LaunchGraph:
        found = self._found
        faults = (_as_late(fault, context) for fault in found.faults)
        return LaunchGraph(
            self._file,
            arguments=tuple(found.arguments),
            nodes=tuple(found.nodes),
            processes=tuple(found.processes),
            includes=tuple(found.includes),
            environment=tuple(found.environment),
            files=tuple(self._uses),
            used=frozenset(context.used),
            faults=_each_once(faults),
            # What nothing declares is a fault, and all that is not known of it follows from that.
            unread=_each_once(u for u in found.unread if not u.reason.endswith(NOT_DECLARED)),
        )

    def _context_of(self, source: SourceText, state: State) -> Context:
        return Context(
            source,
            package_files.installed_path(self._package, source.file),
            self._allowance,
            self._fault,
            self._expression,
            state,
            files=(source.file,),
        )

    def _fault(self, kind: LaunchFaultKind, span: Span, message: str, name: str) -> None:
        self._found.faults.append(LaunchFault(kind, span, message, name))

    def _expression(self, text: str, span: Span) -> Value:
        return expression(text, span, self._allowance, self)

    def _visit_file(self, source: SourceText, context: Context) -> None:
        before, self._context = self._context, context
        try:
            if package_files.is_python_launch(source):
                description = read_python(source, self._allowance, self, self._found)
            else:
                description = read_markup(self._package, source, context, self._found)
            self._visitor.visit(description, context)
        finally:
            self._context = before

    # Includes, and functions that are called late.

    def include(self, target: PlacedText, context: Context) -> FileRead:
        """Visit an included file."""
        path = str(target)
        place = share_path(path)
        if place is None:
            return FileRead(reason="which file is included is not known before the launch")
        source = package_files.read_file(self._package, path)
        if isinstance(source, str):
            return FileRead(reason=source)
        if source.file in context.files:
            message = f"{source.file} includes itself; remove the include"
            context.fault(LaunchFaultKind.INCLUDE_LOOP, target.span, message, source.file)
            return FileRead(path=source.file, reason="it includes itself")
        self._read += 1
        if self._read > FILES_LIMIT:
            return FileRead(path=source.file, reason=f"more than {FILES_LIMIT} files are included")
        inner = self._context_of(source, context.state)
        inner.conditions, inner.after = context.conditions, context.after
        inner.exit_of = context.exit_of
        inner.files = (*context.files, source.file)
        unread, includes = len(self._found.unread), len(self._found.includes)
        with self._allowance:
            self._visit_file(source, inner)
        context.used |= inner.used
        context.declared |= inner.declared
        # A file that is not available may take arguments that are set around it.
        beyond = any(include.is_unknown for include in self._found.includes[includes:])
        complete = len(self._found.unread) == unread and not beyond
        accepts = frozenset(inner.used | inner.declared) if complete else None
        return FileRead(path=source.file, accepts=accepts)

    def launch_file(self, package: str, name: str) -> str:
        """Return the path of the launch file of a package that has a name."""
        return package_files.launch_file(self._package, package, name)

    def call(self, function: Value, positional: Sequence[Value], context: Context) -> Value:
        """Return what a function of a launch file returns."""
        before, self._context = self._context, context
        try:
            return function_call(function, positional, self._allowance, self, self._found)
        finally:
            self._context = before

    # The queries of Python; see `World`.

    def read(self, path: str, span: Span) -> SourceText | str:
        """Return the text of a file below a share folder, or why it cannot be had."""
        self._uses.append(FileUse(Located(path, span)))
        return package_files.read_file(self._package, path)

    def exists(self, path: str) -> bool | None:
        """Return whether there is a file or folder; None if unknown."""
        return package_files.exists(self._package, path)

    def module(self, path: str, run: Interpreter, node: ast.AST) -> Scope | None:
        """Return the names of a Python module of a available package."""
        del node
        if path not in self._modules:
            self._modules[path] = None
            self._read += 1
            source = module_of(self._package, path) if self._read <= FILES_LIMIT else None
            if source is not None:
                inner = Interpreter(source, run.allowance, self)
                self._modules[path] = inner.module_scope()
        return self._modules[path]

    def perform(self, value: Value, span: Span) -> Value:
        """Return the text that substitutions represent, while a function is called."""
        if self._context is None:
            return Unknown("substitutions have no text yet", span)
        return perform(value, self._context, span)

    def configuration(self, name: str) -> Value:
        """Return the value of an argument; None if there is none."""
        if self._context is None:
            return None
        self._context.used.add(name)
        return self._context.state.configurations.get(name)

    def directory(self, source: SourceText) -> str:
        """Return the path of a launch file as it is installed."""
        return package_files.installed_path(self._package, source.file)

    def variable(self, name: str) -> str | None:
        """Return an environment variable as the target or a README sets it; None for others."""
        return self._variables.get(name)

    @cached_property
    def _variables(self) -> Mapping[str, str]:
        """What a README tells users to set, and the distribution that the package is judged for."""
        sources = [*files_around(self._package, README)]
        exports = [match for it in sources for match in _EXPORT.finditer(it.text)]
        found = {match[1]: match[2] for match in reversed(exports)}
        distro = detect_target(self._package).distro or table("profiles")["ros2"]["distro"]
        return {**found, "ROS_DISTRO": distro}


def _as_late(fault: LaunchFault, context: Context) -> LaunchFault:
    """Return the fault of an argument that is declared, but only behind its use, as such."""
    if fault.kind is LaunchFaultKind.UNDECLARED_ARGUMENT and fault.name in context.declared:
        message = f"argument {fault.name!r} is used before it is declared"
        return replace(fault, kind=LaunchFaultKind.LATE_ARGUMENT, message=message)
    return fault


def _each_once(items: Iterable[_Item]) -> tuple[_Item, ...]:
    by_place: dict[object, _Item] = {}
    for item in items:
        words = item.message if isinstance(item, LaunchFault) else item.reason
        by_place.setdefault((item.span.source.file, item.span.start, words), item)
    return tuple(by_place.values())
