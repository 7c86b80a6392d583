"""Evaluates a launch file in Python: names, calls and tests; the results are values."""

from __future__ import annotations

import ast
import posixpath
import re
from collections.abc import Iterable, Sequence
from typing import Protocol

from checker.launch.ros2.classes import CLASSES, ROOTS
from checker.launch.ros2.graph import (
    Condition,
    LaunchFault,
    LaunchFaultKind,
    Unread,
    is_known,
)
from checker.launch.ros2.python import methods
from checker.launch.ros2.python.call import Call
from checker.launch.ros2.python.expressions import bounded, each, evaluate, plain, sequence
from checker.launch.ros2.python.library import BUILTINS, CONSTANTS, FUNCTIONS
from checker.launch.ros2.python.scope import (
    LocalFunction,
    Method,
    Partial,
    Scope,
)
from checker.launch.ros2.python.statements import RETURNED, Flow, run_block
from checker.launch.ros2.values import (
    Allowance,
    Choice,
    FilePath,
    Guarded,
    Made,
    PlacedText,
    Symbol,
    Unknown,
    Value,
    add_place,
    chosen_value,
    is_substitution,
)
from checker.source.python_places import span_of_node
from checker.source.text import Located, SourceText, Span


class World(Protocol):
    """Environment of a launch file: the queries during its evaluation."""

    def read(self, path: str, span: Span) -> SourceText | str:
        """Return the text of a file below a share folder, or why it cannot be had."""

    def exists(self, path: str) -> bool | None:
        """Return whether there is a file or folder; None if its package is not available."""

    def module(self, path: str, run: Interpreter, node: ast.AST) -> Scope | None:
        """Return the names of a Python module of a available package."""

    def perform(self, value: Value, span: Span) -> Value:
        """Return the text that substitutions represent."""

    def configuration(self, name: str) -> Value:
        """Return the value of an argument; None if there is none."""

    def directory(self, source: SourceText) -> str:
        """Return the path of a launch file as it is installed."""

    def variable(self, name: str) -> str | None:
        """Return an environment variable as the target or a README sets it; None for others."""


class Interpreter:
    """The evaluation of one launch file.

    Attributes:
        source: The file whose code is being evaluated.
        allowance: What it may still take.
        world: What it may query.
        guards: Conditions around the statement that is being evaluated.
        handled: Names of the errors that each `try` around it handles, and its number of guards.
        by_argument: Whether a value that was read depends on an argument or a file.
        may_change: Whether the last call may have changed what is launched: it got something that
            can hold actions, or starts programs.
        notes: What was skipped.
        faults: What the code does that stops the launch, or decides it by mistake, by place.
    """

    def __init__(self, source: SourceText, allowance: Allowance, world: World) -> None:
        """Begin without any names."""
        self.source = source
        self.allowance = allowance
        self._active: list[ast.AST] = []
        self.world = world
        self.guards: list[Condition] = []
        self.handled: list[tuple[frozenset[str], int]] = []
        self.by_argument = False
        self.may_change = False
        self.notes: list[Unread] = []
        self.faults: dict[Span, LaunchFault] = {}

    def module_scope(self, tree: ast.Module | None = None) -> Scope:
        """Return the names that the file defines."""
        scope = Scope()
        scope.values["__file__"] = PlacedText(
            self.world.directory(self.source), self.source.whole()
        )
        scope.values["__name__"] = PlacedText("launch_file", self.source.whole())
        if tree is None:
            try:
                tree = ast.parse(self.source.text)
            except (SyntaxError, ValueError, RecursionError, MemoryError):
                return scope
        run_block(self, tree.body, scope)
        return scope

    # Places, and what is not known.

    def span(self, node: ast.AST) -> Span:
        """Return the place of a node."""
        return span_of_node(self.source, node)

    def unknown(self, node: ast.AST, reason: str) -> Unknown:
        """Return a value that is not known."""
        return Unknown(reason, self.span(node))

    def unread(self, node: ast.AST, reason: str) -> None:
        """Note what was skipped."""
        self._note(self.unknown(node, reason))

    def ignored(self, value: Unknown) -> None:
        """Note a call whose effect is not known, unless it has none on what is launched."""
        if self.may_change:
            self._note(value)

    def _note(self, value: Unknown) -> None:
        self.notes.append(Unread(value.reason, value.span, self._by_default))

    @property
    def _by_default(self) -> bool:
        """Whether the defaults of all arguments may lead to what is evaluated."""
        return not any(guard.holds is False for guard in self.guards)

    def handles(self, names: frozenset[str]) -> bool:
        """Return whether a `try` handles an error of these classes, under no further condition."""
        return any(names & own and len(self.guards) == n for own, n in self.handled)

    # Tests and names.

    def truth(self, value: Value) -> bool | None:
        """Return whether a value counts as true; None if that is not known."""
        value = chosen_value(value)
        if isinstance(value, Unknown):
            return None
        if isinstance(value, str) and not is_known(value):
            return None
        if isinstance(value, list | tuple) and any(isinstance(v, Guarded | Unknown) for v in value):
            return None
        if value is None or isinstance(
            value, str | int | float | bool | list | tuple | dict | range
        ):
            return bool(value)
        return True

    def test(self, node: ast.expr, scope: Scope) -> tuple[bool | None, Condition]:
        """Return whether a test is true, and the test as a condition."""
        value = evaluate(self, node, scope)
        if is_substitution(chosen_value(value)):
            self.misuse(node, "true")
        truth = self.truth(value)
        text = Located(ast.unparse(node)[:200], self.span(node))
        return truth, Condition(text, wanted=True, holds=truth)

    def misuse(self, node: ast.AST, result: str) -> None:
        """Note that the code tests an object of launch, not the value that it gets there."""
        self._fault(
            LaunchFaultKind.COMPARISON, node, f"`{ast.unparse(node)[:80]}` is always {result}"
        )

    def _fault(self, kind: LaunchFaultKind, node: ast.AST, message: str) -> None:
        span = self.span(node)
        if self._by_default:
            self.faults[span] = LaunchFault(kind, span, message)

    def watched(self, node: ast.expr, scope: Scope) -> Value:
        """Evaluate a value to assign; `by_argument` is about it alone."""
        self.by_argument = False
        return evaluate(self, node, scope)

    def assign(self, target: ast.expr, value: Value, scope: Scope) -> None:
        """Bind names to a value, or store it in a list or dictionary."""
        match target:
            case ast.Name(id=name):
                scope.bind(name, value, by_argument=self.by_argument)
            case ast.Tuple(elts=targets) | ast.List(elts=targets):
                self._unpack(targets, value, scope)
            case ast.Starred(value=inner):
                self.assign(inner, value, scope)
            case ast.Subscript(value=owner_node, slice=index):
                owner = chosen_value(evaluate(self, owner_node, scope))
                key = chosen_value(evaluate(self, index, scope))
                if _takes(owner, key):
                    owner[key] = self.guarded([value])[0]
                elif not isinstance(owner, Symbol):
                    self.unread(target, "the assignment is not evaluated")
            case ast.Attribute(value=owner_node, attr=name):
                owner = chosen_value(evaluate(self, owner_node, scope))
                if not methods.set_attribute(owner, name, self.guarded([value])[0]):
                    self.unread(target, "the assignment is not evaluated")
            case _:
                self.unread(target, "the assignment is not evaluated")

    def _unpack(self, targets: Sequence[ast.expr], value: Value, scope: Scope) -> None:
        value = chosen_value(value)
        items = each(self, value, targets[0]) if not isinstance(value, Unknown) else [value]
        star = next((n for n, t in enumerate(targets) if isinstance(t, ast.Starred)), None)
        if star is not None and len(items) >= len(targets) - 1:
            behind = len(targets) - star - 1
            middle = items[star : len(items) - behind]
            items = [*items[:star], middle, *items[len(items) - behind :]]
        if len(items) != len(targets):
            reason = value.reason if isinstance(value, Unknown) else "the items are not known"
            items = [self.unknown(target, reason) for target in targets]
        for target, item in zip(targets, items, strict=True):
            self.assign(target, item, scope)

    def guarded(self, values: Iterable[Value]) -> list[Value]:
        """Return values as they are under the conditions around the statement."""
        if not self.guards:
            return [*values]
        return [Guarded(value, tuple(self.guards)) for value in values]

    # What imports, attributes and items represent.

    def builtin(self, name: str) -> Value:
        """Return a function of Python's, or nothing."""
        path = f"builtins.{name}"
        return Symbol(path) if path in BUILTINS or path in FUNCTIONS else None

    def imported(self, path: str, node: ast.AST) -> Value:
        """Return what an import names."""
        if path.startswith(".") or Symbol(path).root not in ROOTS:
            module, _, name = path.rpartition(".")
            with self.allowance:
                names = self.world.module(module, self, node) if module.strip(".") else None
                whole = None if names else self.world.module(path, self, node)
            if names is not None:
                return names.values.get(name, self.unknown(node, f"{path} is not defined"))
            if whole is not None:
                return whole
        return self._named(path, node)

    def names_of(self, module: str, node: ast.AST) -> Iterable[str]:
        """Return the names that `from module import *` binds, as far as they are known."""
        if Symbol(module).root in ROOTS:
            return CLASSES
        with self.allowance:
            own = self.world.module(module, self, node) if module.strip(".") else None
        if own is not None:
            return [name for name in own.values if not name.startswith("_")]
        inside = f"{module}."
        return [path.removeprefix(inside) for path in FUNCTIONS if path.startswith(inside)]

    def attribute(self, owner: Value, name: str, node: ast.AST) -> Value:
        """Return what `owner.name` represents."""
        if isinstance(owner, Unknown):
            return owner
        if isinstance(owner, Scope):
            return owner.values.get(name, self.unknown(node, f"{name} is not defined"))
        if isinstance(owner, Symbol):
            return self._named(f"{owner.path}.{name}", node)
        return methods.attribute(self, owner, name, node)

    def _named(self, path: str, node: ast.AST) -> Value:
        """Return what a name of a library stands for, by its whole path."""
        known = path in CONSTANTS
        return add_place(CONSTANTS[path], self.span(node)) if known else Symbol(path)

    def item(self, owner: Value, key: Value, node: ast.AST) -> Value:
        """Return `owner[key]`."""
        if isinstance(owner, Symbol) and owner.path == "os.environ":
            return self.environment(key, None, node)
        if isinstance(owner, dict):
            if not isinstance(key, list | dict | Unknown) and key in owner:
                return owner[key]
            return self.unknown(node, f"there is no item {str(key)[:60]!r}")
        if isinstance(owner, list | tuple) and type(key) is int and -len(owner) <= key < len(owner):
            value = owner[key]
            steady = not any(isinstance(item, Guarded) for item in owner)
            return value if steady else self.unknown(node, "the order of the items is not known")
        if isinstance(owner, Made):
            return methods.item(self, owner, key, node)
        return bounded(self, node, lambda _: plain(owner)[plain(key)])

    def environment(self, name: Value, default: Value, node: ast.AST) -> Value:
        """Return an environment variable: its default, else `$(env NAME)`."""
        known = self.world.variable(str(name)) if isinstance(name, str) else None
        if known is not None and name == "ROS_DISTRO":
            return PlacedText(known, self.span(node))
        self.by_argument = True
        if default is not None and not isinstance(default, Unknown):
            return default
        if known is not None:
            return PlacedText(known, self.span(node))
        if not isinstance(name, str) or not is_known(name):
            return self.unknown(node, "the name of an environment variable is not known")
        return PlacedText(f"$(env {name})", self.span(node))

    def joined_path(self, parts: Sequence[Value], node: ast.AST) -> Value:
        """Return `pathlib` paths put together."""
        texts: list[str] = []
        for part in map(chosen_value, parts):
            if isinstance(part, Unknown):
                return part
            if not isinstance(part, str | FilePath):
                return self.unknown(node, "a part of a path is not a string")
            texts.append(str(part.text if isinstance(part, FilePath) else part))
        self.allowance.spend_on_text(sum(map(len, texts)))
        return FilePath(posixpath.join(*texts) if texts else ".")

    # Functions and calls.

    def function(
        self, node: ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda, scope: Scope
    ) -> LocalFunction:
        """Return a function with its defaults."""
        defaults = sequence(self, node.args.defaults, scope)
        pairs = zip(node.args.kwonlyargs, node.args.kw_defaults, strict=True)
        named = {
            argument.arg: evaluate(self, default, scope)
            for argument, default in pairs
            if default is not None
        }
        return LocalFunction(node, scope, self.source, defaults, named)

    def call(self, node: ast.Call, scope: Scope) -> Value:
        """Return the value of a call."""
        if isinstance(node.func, ast.Tuple | ast.List | ast.Dict | ast.Constant):
            kind = type(node.func).__name__.lower()
            message = f"the launch stops: a {kind} is called: is a comma missing in front of the (?"
            self._fault(LaunchFaultKind.CALL, node, message)
        function = chosen_value(evaluate(self, node.func, scope))
        positional = sequence(self, node.args, scope)
        named: dict[str, Value] = {}
        places: dict[str, Span] = {}
        for keyword in node.keywords:
            value = evaluate(self, keyword.value, scope)
            if keyword.arg is not None:
                named[keyword.arg] = value
                places[keyword.arg] = self.span(keyword)
                continue
            value = chosen_value(value)
            if not isinstance(value, dict):
                reason = value.reason if isinstance(value, Unknown) else "it is not a dictionary"
                return self.unknown(keyword.value, reason)
            named |= {str(key): item for key, item in value.items()}
        value = self.called(function, positional, named, node, places)
        self.may_change = _may_change(function, (*positional, *named.values()))
        return value

    def called(
        self,
        function: Value,
        positional: list[Value],
        named: dict[str, Value],
        node: ast.AST,
        places: dict[str, Span] | None = None,
    ) -> Value:
        """Return what a function makes of its arguments."""
        self.allowance.spend(1 + len(positional) + len(named))
        with self.allowance:
            match function:
                case Unknown():
                    return function
                case LocalFunction(node=body) if body not in self._active or not any(
                    isinstance(it, Unknown) for it in (*positional, *named.values())
                ):
                    return self._called_locally(function, positional, named, node)
                case Partial(function=inner, positional=first, named=before):
                    return self.called(inner, [*first, *positional], {**before, **named}, node)
                case Method(owner=owner, name=name):
                    return methods.call(self, owner, name, positional, named, node)
                case Symbol():
                    return self._called_symbol(function, positional, named, node, places or {})
        # Which condition ends a recursion over an unknown value is not known either.
        recurs = isinstance(function, LocalFunction)
        why = "it calls itself with an unknown value" if recurs else "it is not a function"
        return self.unknown(node, f"the called value is not known: {why}")

    def _called_symbol(
        self,
        symbol: Symbol,
        positional: list[Value],
        named: dict[str, Value],
        node: ast.AST,
        places: dict[str, Span],
    ) -> Value:
        work = FUNCTIONS.get(symbol.path) or BUILTINS.get(symbol.path)
        if work is not None:
            return Call(self, node, positional, named).evaluated(work)
        if symbol.root in ROOTS and symbol.last in CLASSES:
            parameters = CLASSES[symbol.last]
            values = dict(zip(parameters, positional, strict=False)) | named
            rest = tuple(positional[len(parameters) :])
            return Made(symbol.last, values, self.span(node), places, rest)
        return self.unknown(node, f"{symbol.path.removeprefix('builtins.')} is not evaluated")

    def _called_locally(
        self,
        function: LocalFunction,
        positional: list[Value],
        named: dict[str, Value],
        node: ast.AST,
    ) -> Value:
        scope = Scope(outer=function.scope, guards=len(self.guards))
        if _is_generator(function.node):
            scope.yielded = []
        problem = self._bind(function, positional, named, scope, node)
        if problem is not None:
            return problem
        before, self.source = self.source, function.source
        self._active.append(function.node)
        try:
            if isinstance(function.node, ast.Lambda):
                return evaluate(self, function.node.body, scope)
            flow, value = run_block(self, function.node.body, scope)
            if scope.yielded is not None:
                return scope.yielded
        finally:
            self.source = before
            self._active.pop()
        if flow is Flow.RAISE and not scope.returned:
            return self.unknown(node, "the call raises an error")
        if scope.returned:
            if flow is not Flow.RAISE and value is not RETURNED:
                value = value if isinstance(value, Guarded) else Guarded(value, ())
                scope.returned.append(value)
            return Choice(tuple(scope.returned))
        return value

    def _bind(
        self,
        function: LocalFunction,
        positional: list[Value],
        named: dict[str, Value],
        scope: Scope,
        node: ast.AST,
    ) -> Unknown | None:
        """Bind the parameters of a function to its arguments; return why that is not possible."""
        arguments = function.node.args
        names = [parameter.arg for parameter in (*arguments.posonlyargs, *arguments.args)]
        values = dict(function.named_defaults)
        values |= zip(names[len(names) - len(function.defaults) :], function.defaults, strict=True)
        values |= zip(names, positional, strict=False)
        rest = positional[len(names) :]
        others: dict[str, Value] = {}
        known = {*names, *(parameter.arg for parameter in arguments.kwonlyargs)}
        for name, value in named.items():
            (values if name in known else others)[name] = value
        if arguments.vararg is not None:
            values[arguments.vararg.arg] = tuple(rest)
            rest = []
        if arguments.kwarg is not None:
            values[arguments.kwarg.arg] = others
            others = {}
        missing = known - values.keys()
        if rest or others or missing:
            return self.unknown(node, "the arguments do not fit the function")
        scope.values |= values
        return None


_STARTS = re.compile(r"subprocess\.|multiprocessing\.|os\.(?:system|popen|exec|spawn|posix_spawn)")
"""Functions that start programs."""
_WRITES = frozenset({"yaml.dump", "yaml.safe_dump", "json.dump", "pprint.pprint"})
"""Functions that get data and only write them."""


def _may_change(function: Value, arguments: Sequence[Value]) -> bool:
    """Return whether a call may change what is launched, of which nothing is known."""
    if isinstance(function, Symbol) and function.path in _WRITES:
        return False
    if isinstance(function, Symbol) and _STARTS.match(function.path):
        return True
    owner = function
    while isinstance(owner, Method):
        owner = owner.owner
    return any(isinstance(it, Made | list | dict | Guarded | Choice) for it in (owner, *arguments))


def _is_generator(function: ast.AST) -> bool:
    """Return whether a function yields; functions inside it do not count."""
    waiting = [*ast.iter_child_nodes(function)]
    while waiting:
        part = waiting.pop()
        if isinstance(part, ast.Yield | ast.YieldFrom):
            return True
        if not isinstance(part, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            waiting += ast.iter_child_nodes(part)
    return False


def _takes(owner: Value, key: Value) -> bool:
    """Return whether an item can be stored under a key."""
    if isinstance(owner, list):
        return isinstance(key, int) and -len(owner) <= key < len(owner)
    return isinstance(owner, dict) and isinstance(key, str | int | float)
