"""Names in launch files in Python: their strings; nothing of them is run."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from checker.editor.names.mention import Role, WrittenName
from checker.editor.names.readers.launch_names import ARGUMENT
from checker.editor.names.readers.values import ELSEWHERE, files_named, names_in
from checker.source.python_places import span_of_node
from checker.source.text import SourceText

_DECLARING = ("DeclareLaunchArgument", "SetLaunchConfiguration")
_NAMING = ("LaunchConfiguration", "LaunchConfigurationEquals", "LaunchConfigurationNotEquals")
_QUOTES = re.compile(r"""[A-Za-z]{0,2}('''|\"\"\"|'|")""")
_FILES_OF = ("IncludeLaunchDescription", "Command", "ExecuteProcess", "Node")


class PythonNames:
    """The reading of one file.

    Attributes:
        names: What is written, as it is found.
        values: Its strings.
    """

    def __init__(self, source: SourceText, tree: ast.Module) -> None:
        """Read all of it."""
        self.names: list[WrittenName] = []
        self.values: set[str] = set()
        self._source, self._text = source, source.text
        waiting: list[tuple[ast.AST, str, tuple[str, ...]]] = [(tree, "", ())]
        while waiting:
            waiting += self._node(*waiting.pop())

    def _node(
        self, node: ast.AST, key: str, files: tuple[str, ...]
    ) -> Iterator[tuple[ast.AST, str, tuple[str, ...]]]:
        """Read one node; yield what is in it, with its receivers and files named with it."""
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            self._string(node, node.value, key, files)
        elif isinstance(node, ast.JoinedStr):
            self._composed(node, key)
        elif isinstance(node, ast.Call):
            yield from self._call(node, key, files)
        elif isinstance(node, ast.keyword):
            yield node.value, node.arg or key, files
        elif isinstance(node, ast.Dict):
            yield from self._dict(node, key, files)
        elif isinstance(node, ast.Tuple) and key == "launch_arguments" and node.elts:
            self._argument(node.elts[0], Role.MAY_NAME, files or ELSEWHERE)
            yield from ((child, key, files) for child in node.elts[1:])
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            yield node.value, node.targets[0].id, files
        elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            return  # a docstring
        else:
            if isinstance(node, ast.Subscript) and _name(node.value) == "launch_configurations":
                self._argument(node.slice, Role.NAMES)
            yield from ((child, key, files) for child in ast.iter_child_nodes(node))

    def _call(
        self, node: ast.Call, key: str, files: tuple[str, ...]
    ) -> Iterator[tuple[ast.AST, str, tuple[str, ...]]]:
        called = _name(node.func)
        arguments: list[ast.AST] = [*node.args, *node.keywords]
        if called in _FILES_OF:
            files = self._files(node)
        named = next((it.value for it in node.keywords if it.arg == "name"), None)
        first = node.args[0] if node.args else named
        if called in (*_DECLARING, *_NAMING) and first is not None:
            self._argument(first, Role.DEFINES if called in _DECLARING else Role.NAMES)
            arguments = [it for it in arguments if it is not first]
            key = str(first.value) if isinstance(first, ast.Constant) else key
        yield node.func, key, files
        for it in arguments:
            is_default = isinstance(it, ast.keyword) and it.arg == "default_value"
            yield (it.value if is_default and isinstance(it, ast.keyword) else it), key, files

    def _files(self, node: ast.AST) -> tuple[str, ...]:
        texts = (it.value for it in ast.walk(node) if isinstance(it, ast.Constant))
        found = (name for text in texts if isinstance(text, str) for name in files_named(text))
        return tuple(dict.fromkeys(found))

    def _dict(
        self, node: ast.Dict, key: str, files: tuple[str, ...]
    ) -> Iterator[tuple[ast.AST, str, tuple[str, ...]]]:
        for name, value in zip(node.keys, node.values, strict=True):
            word = name.value if isinstance(name, ast.Constant) else None
            if name is not None and key == "launch_arguments":
                self._argument(name, Role.MAY_NAME, files or ELSEWHERE)
            elif name is not None and not isinstance(word, str):
                yield name, key, files
            yield value, word if isinstance(word, str) else key, files

    def _argument(self, node: ast.AST, role: Role, files: tuple[str, ...] = ()) -> None:
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
            return
        start = self._text_start(node, node.value)
        if start is not None and node.value:
            end = start + len(node.value)
            self.names.append(WrittenName(ARGUMENT, node.value, start, end, role, files))

    def _string(self, node: ast.Constant, text: str, key: str, files: tuple[str, ...]) -> None:
        self.values.add(text)
        start = self._text_start(node, text)
        if start is None:
            return
        is_argument = key in ("arguments", "args", "cmd", "ros_arguments") or ":=" in text
        for found in names_in(text, start, key, words=is_argument):
            passed = files if files and found.kinds == ARGUMENT else found.files
            kinds, name = found.kinds, found.name
            self.names.append(WrittenName(kinds, name, found.start, found.end, found.role, passed))

    def _composed(self, node: ast.JoinedStr, key: str) -> None:
        """Note an f-string as a composed name."""
        parts = (
            it.value if isinstance(it, ast.Constant) and isinstance(it.value, str) else "#{}"
            for it in node.values
        )
        span = span_of_node(self._source, node)
        start, end = span.start, span.end
        for found in names_in("".join(parts), 0, key):
            if found.kinds != ARGUMENT:
                kinds = found.kinds
                self.names.append(WrittenName(kinds, found.name, start, end, Role.MAY_NAME))

    def _text_start(self, node: ast.Constant, text: str) -> int | None:
        """Return where the text of a string begins; None if it is written otherwise."""
        span = span_of_node(self._source, node)
        start, end = span.start, span.end
        quotes = _QUOTES.match(self._text, start)
        if quotes is None:
            return None
        inside = quotes.end()
        written = self._text[inside : end - len(quotes[1])]
        return inside if written == text else None


def _name(node: ast.AST) -> str:
    """Return the last word of what is called."""
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else ""
