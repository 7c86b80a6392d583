"""Files that a setup.py installs: `data_files` and executables, as far as they are literals.

The file is read as a syntax tree and never run. Texts, lists, names that are set once, f-strings,
`os.path.join` and `glob` are followed; anything else makes the answer incomplete.
"""

from __future__ import annotations

import ast
import posixpath
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import suppress

from msgspec.structs import replace

from checker.base.record import Record
from checker.source.python_places import span_of_node
from checker.source.text import Located, SourceText, Span

LIMIT = 200_000
"""Characters of a file that is read."""
_DEEPEST = 50
_SCRIPTS = ("console_scripts", "gui_scripts")
_EXECUTABLE = re.compile(r"\s*([\w.-]+)\s*=\s*([\w.]+)\s*(?::\s*([\w.]+)\s*)?")
_JOINS = ("os.path.join", "path.join", "join")
_GLOBS = ("glob", "glob.glob")


class Pattern(Record):
    """The pattern of `glob`; `**` reaches into folders only if it is recursive."""

    text: str
    recursive: bool = False


class DataFiles(Record, eq=False):
    """An entry of `data_files`.

    Attributes:
        destination: The destination below the prefix, such as `share/arm/launch`.
        files: Paths from the folder of setup.py.
        patterns: Patterns for such paths.
        span: The entry.
    """

    destination: str
    files: tuple[Located[str], ...]
    patterns: tuple[Pattern, ...]
    span: Span


class Executable(Record, eq=False):
    """An entry of `console_scripts`: `talker = arm.nodes:main`.

    Attributes:
        name: The name of the program.
        module: Dotted.
        function: The function in the module; empty if none is named.
        span: The entry.
    """

    name: str
    module: str
    function: str
    span: Span


class SetupFile(Record, eq=False):
    """A setup.py.

    Attributes:
        data_files: Entries that can be read.
        complete: Whether these are all.
        span: `data_files`, or the call of `setup`.
        executables: Entries of `console_scripts` that can be read.
        plain: Whether modules lie where their names say, and no option is set in the file.
        packages: The Python packages that are installed; None if they are not listed by name.
        has_commands: Whether it has commands of its own, `cmdclass`, which may install otherwise.
    """

    data_files: tuple[DataFiles, ...]
    complete: bool
    span: Span
    executables: tuple[Executable, ...] = ()
    plain: bool = True
    packages: frozenset[str] | None = None
    has_commands: bool = False


class _Unknown(Exception):
    """An expression that is not followed."""


def read_setup(source: SourceText) -> SetupFile | None:
    """Read a setup.py; None if it is no Python or calls no `setup`."""
    if len(source.text) > LIMIT:
        return None
    try:
        tree = ast.parse(source.text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
    call = next((call for call in _calls(tree) if _name(call.func) == "setup"), None)
    if call is None:
        return None
    reader = _Reader(source, _constants(tree))
    given = {word.arg: word.value for word in call.keywords}
    scripts = tuple(reader.executables(given["entry_points"])) if "entry_points" in given else ()
    plain = {"package_dir", "options", None}.isdisjoint(given)
    packages = reader.listed(given["packages"]) if "packages" in given else None
    if "data_files" in given:
        setup = reader.setup_file(given["data_files"])
    else:
        setup = SetupFile((), None not in given, span_of_node(reader.source, call))
    commands = "cmdclass" in given
    return replace(
        setup, executables=scripts, plain=plain, packages=packages, has_commands=commands
    )


def _calls(tree: ast.Module) -> Iterator[ast.Call]:
    for statement in tree.body:
        if isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call):
            yield statement.value


def _constants(tree: ast.Module) -> dict[str, ast.expr]:
    """Return the names that are set at the top of the file, except those that change."""
    values: dict[str, ast.expr] = {}
    for statement in tree.body:
        if isinstance(statement, ast.Assign):
            for target in statement.targets:
                if isinstance(target, ast.Name):
                    values[target.id] = statement.value
    times = Counter(name for node in ast.walk(tree) for name in _set_by(node))
    plain = (ast.Constant, ast.JoinedStr)
    handed = {name for node in ast.walk(tree) for name in _handed_over(node)}
    return {
        name: value
        for name, value in values.items()
        if times[name] == 1 and (isinstance(value, plain) or name not in handed)
    }


def _set_by(node: ast.AST) -> Iterator[str]:
    """Yield the name that an assignment sets or adds to, whether at the top or in a loop."""
    if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
        yield node.id


def _handed_over(node: ast.AST) -> Iterator[str]:
    """Yield the names of what a call may change: `files.append(…)`, `add_folder(files, "x")`."""
    if not isinstance(node, ast.Call) or _name(node.func) in (*_JOINS, *_GLOBS):
        return
    if isinstance(node.func, ast.Attribute) and isinstance(node.func.value, ast.Name):
        yield node.func.value.id
    yield from (word.id for word in node.args if isinstance(word, ast.Name))


def _name(node: ast.expr) -> str:
    """Return a dotted name: `os.path.join`; nothing for what is none."""
    parts: list[str] = []
    while isinstance(node, ast.Attribute):
        parts.append(node.attr)
        node = node.value
    return ".".join([node.id, *reversed(parts)]) if isinstance(node, ast.Name) else ""


class _Reader:
    def __init__(self, source: SourceText, names: Mapping[str, ast.expr]) -> None:
        self.source = source
        self.names = names

    def setup_file(self, given: ast.expr) -> SetupFile:
        """Read what is given as `data_files`."""
        entries: list[DataFiles] = []
        complete = True
        for entry in self._entries(given, 0):
            if entry is None:
                complete = False
            else:
                entries.append(entry)
        return SetupFile(tuple(entries), complete, span_of_node(self.source, given))

    def _entries(self, node: ast.expr, depth: int) -> Iterator[DataFiles | None]:
        if depth > _DEEPEST:
            yield None
        elif isinstance(node, ast.Name) and node.id in self.names:
            yield from self._entries(self.names[node.id], depth + 1)
        elif isinstance(node, ast.List | ast.Tuple):
            for item in node.elts:
                yield self._entry(item)
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
            yield from self._entries(node.left, depth + 1)
            yield from self._entries(node.right, depth + 1)
        else:
            yield None

    def _entry(self, node: ast.expr) -> DataFiles | None:
        if not isinstance(node, ast.Tuple | ast.List) or len(node.elts) != 2:
            return None
        try:
            destination = self._text(node.elts[0], 0)
            items = tuple(self._items(node.elts[1], 0))
        except _Unknown:
            return None
        return DataFiles(
            destination,
            tuple(item for item in items if isinstance(item, Located)),
            tuple(item for item in items if isinstance(item, Pattern)),
            span_of_node(self.source, node),
        )

    def executables(self, node: ast.expr) -> Iterator[Executable]:
        """Yield the programs among what is given as `entry_points`."""
        if isinstance(node, ast.Name):
            node = self.names.get(node.id, node)
        if not isinstance(node, ast.Dict):
            return
        for key, group in zip(node.keys, node.values, strict=True):
            if not isinstance(key, ast.Constant) or key.value not in _SCRIPTS:
                continue
            for entry in group.elts if isinstance(group, ast.List | ast.Tuple) else ():
                with suppress(_Unknown):
                    if match := _EXECUTABLE.fullmatch(self._text(entry, 0)):
                        yield Executable(
                            match[1], match[2], match[3] or "", span_of_node(self.source, entry)
                        )

    def listed(self, node: ast.expr) -> frozenset[str] | None:
        """Return the names of a list; None if an item is no plain text."""
        try:
            items = [*self._items(node, 0)]
        except _Unknown:
            return None
        names = frozenset(item.value for item in items if isinstance(item, Located))
        return names if len(names) == len(items) else None

    def _items(self, node: ast.expr, depth: int) -> Iterator[Located[str] | Pattern]:
        if depth > _DEEPEST:
            raise _Unknown
        if isinstance(node, ast.Name) and node.id in self.names:
            yield from self._items(self.names[node.id], depth + 1)
        elif isinstance(node, ast.List | ast.Tuple):
            for item in node.elts:
                yield Located(self._text(item, 0), span_of_node(self.source, item))
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
            yield from self._items(node.left, depth + 1)
            yield from self._items(node.right, depth + 1)
        elif isinstance(node, ast.Call) and _name(node.func) in _GLOBS and node.args:
            recursive = any(
                word.arg == "recursive"
                and isinstance(word.value, ast.Constant)
                and word.value.value is True
                for word in node.keywords
            )
            yield Pattern(self._text(node.args[0], 0), recursive)
        else:
            raise _Unknown

    def _text(self, node: ast.expr, depth: int) -> str:
        if depth > _DEEPEST:
            raise _Unknown
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            return node.value
        if isinstance(node, ast.Name) and node.id in self.names:
            return self._text(self.names[node.id], depth + 1)
        if isinstance(node, ast.JoinedStr):
            return "".join(self._text(part, depth + 1) for part in node.values)
        if isinstance(node, ast.FormattedValue) and node.format_spec is None:
            return self._text(node.value, depth + 1)
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
            return self._text(node.left, depth + 1) + self._text(node.right, depth + 1)
        if isinstance(node, ast.Call) and _name(node.func) in _JOINS and not node.keywords:
            return posixpath.join(*(self._text(word, depth + 1) for word in node.args))
        raise _Unknown
