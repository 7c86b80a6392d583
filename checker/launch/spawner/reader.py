"""The spawner of a package: its functions, the emitted XML, and unread parts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from checker.base.record import Record
from checker.launch.spawner.evaluator.calls import CALLS, call_function
from checker.launch.spawner.evaluator.expressions import EXPRESSIONS
from checker.launch.spawner.evaluator.interpreter import Handler, Interpreter
from checker.launch.spawner.evaluator.operators import OPERATORS
from checker.launch.spawner.evaluator.statements import STATEMENTS, function_of
from checker.launch.spawner.evaluator.variables import VARIABLES
from checker.launch.spawner.files import SpawnerFiles
from checker.launch.spawner.launcher import (
    EXECUTABLES_ARGUMENTS,
    GROUND_TRUTH,
    NO_CHANGES,
    SAMPLE_NAME,
    SAMPLE_WORLD,
    SPAWNER_ARGUMENTS,
    Argument,
    changes,
    launcher_globals,
    ruby_value,
)
from checker.launch.spawner.limits import (
    MAX_FILE_LENGTH,
    MAX_STEPS_OF_VARIANTS,
    Budget,
    LimitReached,
)
from checker.launch.spawner.methods.call import Call
from checker.launch.spawner.scope import Function, Scope
from checker.launch.spawner.signals import (
    Broken,
    Continued,
    Returned,
    RubyError,
    Unread,
    Unreadable,
)
from checker.launch.spawner.values import RubyString, class_name
from checker.source.emitted import EmittedText
from checker.source.ruby import ParsesTooSlowly, RubyNode, parse_ruby
from checker.source.ruby_repairs import SyntaxFault
from checker.source.ruby_syntax import not_understood, syntax_faults
from checker.source.text import SourceText, Span

_HANDLERS: Mapping[str, Handler] = {
    **EXPRESSIONS,
    **VARIABLES,
    **OPERATORS,
    **STATEMENTS,
    **CALLS,
}
"""Handlers by type of node; a node of another type is not read."""


class Spawner(Record, eq=False):
    """A `launch/spawner.rb`.

    Attributes:
        entry: Its text.
        functions: Functions that it and the files it loads define, by name.
        spawn: What `spawner` emits for `SPAWNER_ARGUMENTS` without ground truth.
        executables: What `rosExecutables` emits for `EXECUTABLES_ARGUMENTS`.
        sources: All files read for it, the entry first.
        unread: What could not be read; empty if everything was.
        syntax_faults: Syntax errors that are certain.
        not_understood: The place where a file first exceeds the grammar, if it has no such
            error.
    """

    entry: SourceText
    functions: dict[str, Function]
    spawn: EmittedText | Unread
    executables: EmittedText | Unread
    sources: tuple[SourceText, ...]
    unread: tuple[Unread, ...]
    syntax_faults: tuple[SyntaxFault, ...]
    not_understood: tuple[Span, ...]
    _program: _Program

    @property
    def trees(self) -> tuple[RubyNode, ...]:
        """The syntax trees of the Ruby files among the sources."""
        return tuple(self._program.trees.values())

    def lacks(self, function: str) -> bool:
        """Return whether the file was read to its end and defines no such function.

        Args:
            function: `spawner` or `rosExecutables`.
        """
        result = self.spawn if function == "spawner" else self.executables
        lacking = isinstance(result, Unread) and result.reason == _NO_FUNCTION.format(function)
        return lacking and not (self.syntax_faults or self.not_understood)

    def evaluate(
        self, function: str, arguments: Sequence[Argument], *, ground_truth: bool = False
    ) -> EmittedText | Unread:
        """Call a function of the spawner.

        Args:
            function: `spawner` or `rosExecutables`, or any other it defines.
            arguments: Positional arguments.
            ground_truth: Value of `$enableGroundTruth`.
        """
        return self._program.call(function, arguments, {GROUND_TRUTH: ground_truth})

    def variants(self) -> Iterator[tuple[str, EmittedText | Unread]]:
        """Yield what `spawner` emits when one parameter or global of the launcher changes.

        All these runs share their steps.
        """
        function, budget = self.functions.get("spawner"), Budget(MAX_STEPS_OF_VARIANTS)
        names = [parameter.name for parameter in function.parameters] if function else []
        for name, arguments, changed in changes(names):
            yield name, self._program.call("spawner", arguments, changed, budget)


_NO_FUNCTION = "defines no function {}"


def read_spawner(files: SpawnerFiles, path: str, entry: SourceText) -> Spawner:
    """Read a spawner without running Ruby.

    Args:
        files: The workspace.
        path: Path of `launch/spawner.rb` relative to the workspace.
        entry: Its text.
    """
    program = _Program(files, entry, path)
    spawn = program.call("spawner", SPAWNER_ARGUMENTS)
    executables = program.call("rosExecutables", EXECUTABLES_ARGUMENTS)
    unread: dict[tuple[int, int, str], Unread] = {}
    for result in (spawn, executables):
        if isinstance(result, Unread):
            unread.setdefault((result.span.start, result.span.end, result.reason), result)
    faults = tuple(fault for tree in program.trees.values() for fault in syntax_faults(tree))
    strange = () if faults else tuple(filter(None, map(not_understood, program.trees.values())))
    sources = {path: entry, **program.sources}
    return Spawner(
        entry,
        program.functions,
        spawn,
        executables,
        tuple(sources.values()),
        tuple(unread.values()),
        faults,
        strange,
        program,
    )


@dataclass(eq=False)
class _Program:
    """A spawner's files, and the results of the calls so far."""

    files: SpawnerFiles
    entry: SourceText
    path: str
    trees: dict[str, RubyNode] = field(default_factory=dict)
    sources: dict[str, SourceText] = field(default_factory=dict)
    functions: dict[str, Function] = field(default_factory=dict)

    @cached_property
    def _tree(self) -> RubyNode | str:
        """The entry's tree, or the reason why there is none."""
        if len(self.entry.text) > MAX_FILE_LENGTH:
            return f"is longer than {MAX_FILE_LENGTH} characters"
        try:
            tree = self.trees[self.path] = parse_ruby(self.entry)
        except ParsesTooSlowly:
            return "takes too long to parse"
        for node in tree.parts:
            if node.type == "method" and "name" in node.fields:
                function = function_of(node, self.path)
                self.functions[function.name] = function
        return tree

    def call(
        self,
        name: str,
        arguments: Sequence[Argument],
        changed: Mapping[str, Argument] = NO_CHANGES,
        budget: Budget | None = None,
    ) -> EmittedText | Unread:
        """Run the file, then one of its functions, from a clean start.

        Args:
            name: The function.
            arguments: Its positional arguments.
            changed: Globals of the launcher with other values than usual.
            budget: The steps that it may take; without it, those of one call.
        """
        whole = self.entry.whole()
        if isinstance(self._tree, str):
            return Unread(whole, self._tree)
        run = Interpreter(self.files, _HANDLERS, self.trees, budget or Budget())
        run.globals.update(launcher_globals(self.files, self.path, changed))
        run.sources[self.path] = self.entry
        try:
            return self._emitted(run, name, arguments)
        except Unreadable as stop:
            return stop.unread
        except RubyError as error:
            return Unread(error.span, f"raises {error.kind}: {error.message[:200]}")
        except (LimitReached, Broken, Continued, Returned, RecursionError) as stop:
            return Unread(whole, _reason(stop))
        finally:
            self.sources.update(run.sources)
            self.functions.update(run.functions)

    def _emitted(
        self, run: Interpreter, name: str, arguments: Sequence[Argument]
    ) -> EmittedText | Unread:
        run.run_file(self.path, self.entry.whole())
        function = run.functions.get(name)
        if function is None:
            return Unread(self.entry.whole(), _NO_FUNCTION.format(name))
        span = function.span
        run.scope = Scope(self.path)
        # With a parameter too few, the rest of what it emits is still worth a look.
        values = [ruby_value(argument) for argument in arguments[: function.most]]
        call = Call(run, function.node, name, None, values, at=span)
        result = call_function(call, function)
        if not isinstance(result, RubyString):
            return Unread(span, f"returns {class_name(result)} instead of a string")
        traced = run.traced(result, span)
        pieces = tuple(piece.with_origin(span) for piece in traced.pieces)
        return EmittedText(span.source.file, traced.text, origin=span, pieces=pieces)


def _reason(stop: Exception) -> str:
    """Return the reason why a run ended outside any construct that could be named."""
    if isinstance(stop, LimitReached):
        return str(stop)
    if isinstance(stop, RecursionError):
        # The depth limit leaves most of Python's stack to the caller; it may have had less.
        return "is nested too deeply"
    return "leaves a loop or a function that it is not in"


__all__ = [
    "EXECUTABLES_ARGUMENTS",
    "GROUND_TRUTH",
    "SAMPLE_NAME",
    "SAMPLE_WORLD",
    "SPAWNER_ARGUMENTS",
    "Spawner",
    "Unread",
    "read_spawner",
]
