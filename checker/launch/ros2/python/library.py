"""Functions of Python, of its library and of ROS that launch files call."""

from __future__ import annotations

import ast
import posixpath
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

from checker.formats.xacro.expression.builtins import FUNCTIONS as SAFE
from checker.formats.xacro.files import ROOT
from checker.launch.ros2.graph import is_known
from checker.launch.ros2.python import data_functions, moveit
from checker.launch.ros2.python.expressions import bounded, each, hashable, plain
from checker.launch.ros2.python.scope import LocalFunction, Partial
from checker.launch.ros2.values import (
    Choice,
    FilePath,
    FileText,
    Guarded,
    Made,
    OpenFile,
    PlacedText,
    Symbol,
    Unknown,
    Value,
    chosen_value,
    span_of,
)
from checker.source.yaml import read_yaml

if TYPE_CHECKING:
    from checker.launch.ros2.python.interpreter import Interpreter

Work = Callable[["Interpreter", ast.AST, list[Value], dict[str, Value]], Value]

CONSTANTS: Mapping[str, str | float] = MappingProxyType(
    {"os.sep": "/", "os.path.sep": "/", "os.pathsep": ":", "os.linesep": "\n"}
    | dict(data_functions.CONSTANTS)
)
PREFIX = f"{ROOT}-prefix"
"""The folder of the install prefixes of packages."""


def text_of(run: Interpreter, value: Value, node: ast.AST) -> PlacedText | Unknown:
    """Return a path or name as text."""
    value = chosen_value(value)
    if isinstance(value, FilePath):
        return PlacedText(value.text, run.span(node))
    if isinstance(value, str):
        return PlacedText(value, span_of(value, run.span(node)))
    if isinstance(value, Unknown):
        return value
    if isinstance(value, Made):
        return run.unknown(node, f"a text is made of a {value.name} before the launch")
    return run.unknown(node, "is not text")


def texts_of(
    run: Interpreter, values: Iterable[Value], node: ast.AST
) -> list[PlacedText] | Unknown:
    """Return several as text; the first one that is none."""
    texts = []
    for value in values:
        text = text_of(run, value, node)
        if isinstance(text, Unknown):
            return text
        texts.append(text)
    return texts


def first(arguments: list[Value], named: dict[str, Value], *names: str) -> Value:
    """Return the first argument, given by place or by one of some names."""
    if arguments:
        return arguments[0]
    return next((named[name] for name in names if name in named), None)


# Paths.


def _join(run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]) -> Value:
    parts = texts_of(run, arguments, node)
    if isinstance(parts, Unknown) or not parts:
        return parts or run.unknown(node, "os.path.join joins nothing")
    run.allowance.spend_on_text(sum(map(len, parts)))
    return PlacedText(posixpath.join(*map(str, parts)), run.span(node))


_PATH_WORKS: Mapping[str, Callable[[str], str | tuple[str, str]]] = MappingProxyType(
    {
        "dirname": posixpath.dirname,
        "basename": posixpath.basename,
        "splitext": posixpath.splitext,
        "split": posixpath.split,
    }
)


def _path_work(name: str) -> Work:
    def work(
        run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
    ) -> Value:
        text = text_of(run, first(arguments, named, "path", "filename"), node)
        if isinstance(text, Unknown):
            return text
        result = _PATH_WORKS[name](str(text))
        if isinstance(result, tuple):
            return tuple(PlacedText(part, run.span(node)) for part in result)
        return PlacedText(result, run.span(node))

    return work


def _same_path(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    text = text_of(run, first(arguments, named, "path", "filename"), node)
    return (
        text if isinstance(text, Unknown) else PlacedText(posixpath.normpath(text), run.span(node))
    )


def _exists(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    run.by_argument = True
    text = text_of(run, first(arguments, named, "path"), node)
    there = None if isinstance(text, Unknown) else run.world.exists(str(text))
    return run.unknown(node, "whether the file exists is not known") if there is None else there


def _share(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    return _package_folder(run, node, first(arguments, named, "package_name"), ROOT)


def _share_path(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    folder = _share(run, node, arguments, named)
    return folder if isinstance(folder, Unknown) else FilePath(str(folder))


def _prefix(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    return _package_folder(run, node, first(arguments, named, "package_name"), PREFIX)


def _package_folder(run: Interpreter, node: ast.AST, package: Value, folder: str) -> Value:
    name = text_of(run, package, node)
    if isinstance(name, Unknown):
        return name
    if not is_known(name):
        return run.unknown(node, "the name of the package is not known")
    return PlacedText(f"{folder}/{name}", run.span(node))


def _new_path(
    run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]
) -> Value:
    return run.joined_path(arguments, node)


def _directory(run: Interpreter, node: ast.AST, _: list[Value], __: dict[str, Value]) -> Value:
    return run.unknown(node, "the working directory is not known")


# Files.


def _open(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    text = text_of(run, first(arguments, named, "file"), node)
    return text if isinstance(text, Unknown) else OpenFile(str(text))


def _load_yaml(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    content = chosen_value(first(arguments, named, "stream"))
    if isinstance(content, OpenFile | FileText):
        return read_yaml_file(run, content.path, node)
    return content if isinstance(content, Unknown) else run.unknown(node, "the YAML is not known")


def read_yaml_file(run: Interpreter, path: str, node: ast.AST) -> Value:
    """Return what a YAML file contains."""
    run.by_argument = True
    source = run.world.read(path, run.span(node))
    if isinstance(source, str):
        return run.unknown(node, source)
    run.allowance.spend_on_text(min(len(source.text), 90_000))
    root = read_yaml(source).root
    if root is None:
        return run.unknown(node, f"{source.file} cannot be read")
    run.allowance.spend(root.size)
    return root.plain()


# xacro, called from Python.


def _xacro_file(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    file = chosen_value(first(arguments, named, "input_file_name", "input", "filename"))
    path = file.path if isinstance(file, OpenFile) else text_of(run, file, node)
    if isinstance(path, Unknown):
        return path
    return Made(
        "XacroDocument", {"path": str(path), "mappings": named.get("mappings")}, run.span(node)
    )


def _xacro_arguments(
    _: Interpreter, __: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    document = chosen_value(first(arguments, named, "doc"))
    if isinstance(document, Made) and document.name == "XacroDocument" and "mappings" in named:
        document.values["mappings"] = named["mappings"]
    return None


def _xacro_text(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    document = _xacro_file(run, node, arguments, named)
    return document if isinstance(document, Unknown) else xacro_text(run, document, node)


def xacro_text(run: Interpreter, document: Made, node: ast.AST) -> Value:
    """Return the text of an expanded xacro file: `$(command xacro PATH name:=value)`."""
    mappings = chosen_value(document.values["mappings"])
    words = [f"xacro {document.values['path']}"]
    if isinstance(mappings, dict):
        for name, value in mappings.items():
            text = run.world.perform(value, run.span(node))
            words.append(f"{name}:={'$(unknown)' if isinstance(text, Unknown) else text}")
    elif mappings is not None:
        words.append("$(unknown)")
    return PlacedText(f"$(command {' '.join(words)})", document.span)


# Environment, and the rest.


def _getenv(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    default = arguments[1] if len(arguments) > 1 else named.get("default")
    return run.environment(first(arguments, named, "key"), default, node)


def _partial(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    if not arguments:
        return run.unknown(node, "partial() of nothing")
    return Partial(arguments[0], arguments[1:], named)


def _copy(run: Interpreter, __: ast.AST, arguments: list[Value], _: dict[str, Value]) -> Value:
    value = chosen_value(arguments[0]) if arguments else None
    run.allowance.spend(len(value) if isinstance(value, list | dict) else 1)
    return value.copy() if isinstance(value, list | dict) else value


def _nothing(_: Interpreter, __: ast.AST, ___: list[Value], ____: dict[str, Value]) -> Value:
    return None


def _sequence(
    run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]
) -> Value:
    return each(run, arguments[0], node) if arguments else []


def _tuple(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    return tuple(_sequence(run, node, arguments, named))


def _dict(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    entries: dict[Value, Value] = {}
    if arguments:
        given = chosen_value(arguments[0])
        if isinstance(given, dict):
            entries |= given
        else:
            for pair in each(run, given, node):
                if not isinstance(pair, tuple | list) or len(pair) != 2:
                    return run.unknown(node, "the items are not known")
                key = hashable(run, pair[0], node)
                if isinstance(key, Unknown):
                    return key
                entries[key] = pair[1]
    return entries | named


def _map(run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]) -> Value:
    if len(arguments) < 2:
        return run.unknown(node, "map() takes a function and items")
    columns = [each(run, argument, node) for argument in arguments[1:]]
    return [
        run.called(chosen_value(arguments[0]), list(row), {}, node)
        for row in zip(*columns, strict=False)
    ]


def _zip(run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]) -> Value:
    return [*zip(*(each(run, argument, node) for argument in arguments), strict=False)]


def _enumerate(
    run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
) -> Value:
    start = arguments[1] if len(arguments) > 1 else named.get("start", 0)
    items = _sequence(run, node, arguments[:1], {})
    return [*enumerate(items, start if type(start) is int else 0)]


def _reversed(
    run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]
) -> Value:
    return _sequence(run, node, arguments, {})[::-1]


def _chain(run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]) -> Value:
    return [item for argument in arguments for item in each(run, argument, node)]


def _filter(run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]) -> Value:
    if len(arguments) != 2:
        return run.unknown(node, "filter() takes a function and items")
    kept = []
    for item in each(run, arguments[1], node):
        keeps = (
            item
            if arguments[0] is None
            else run.called(chosen_value(arguments[0]), [item], {}, node)
        )
        if run.truth(keeps) is not False:
            kept.append(item)
    return kept


def _string(run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]) -> Value:
    value = chosen_value(arguments[0]) if arguments else ""
    if isinstance(value, str | FilePath | Made | Unknown):
        return text_of(run, value, node)
    return bounded(run, node, lambda budget: SAFE["str"].work(budget, plain(value)))


def _length(run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]) -> Value:
    value = chosen_value(arguments[0]) if arguments else None
    if isinstance(value, list | tuple | dict) and not any(
        isinstance(item, Guarded | Choice | Unknown) for item in value
    ):
        return len(value)
    return bounded(run, node, lambda budget: SAFE["len"].work(budget, plain(value)))


def _is_instance(
    run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]
) -> Value:
    names = {"str": str, "int": int, "float": float, "bool": bool, "list": list, "dict": dict}
    wanted = arguments[1] if len(arguments) == 2 else ()
    kinds = wanted if isinstance(wanted, tuple) else (wanted,)
    if kinds and all(isinstance(kind, Symbol) and kind.last in names for kind in kinds):
        value = chosen_value(arguments[0])
        if not isinstance(value, Unknown):
            return isinstance(value, tuple(names[kind.last] for kind in kinds))
    return run.unknown(node, "isinstance() is not evaluated")


def _safe(name: str) -> Work:
    def work(
        run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
    ) -> Value:
        values = {
            key: value for key, value in named.items() if not isinstance(value, LocalFunction)
        }
        if len(values) != len(named):
            return run.unknown(node, f"{name}() with a function is not evaluated")
        return bounded(
            run,
            node,
            lambda budget: _as_sequence(
                SAFE[name].work(
                    budget,
                    *map(plain, arguments),
                    **{key: plain(value) for key, value in values.items()},
                )
            ),
        )

    return work


def _as_sequence(value: Value) -> Value:
    return (
        value if type(value) in (str, int, float, bool, list, tuple, dict, range) else list(value)
    )


BUILTINS: Mapping[str, Work] = MappingProxyType(
    {f"builtins.{name}": _safe(name) for name in ("int", "float", "bool", "round", "abs", "sum")}
    | {f"builtins.{name}": _safe(name) for name in ("min", "max", "any", "all", "sorted", "repr")}
    | {f"builtins.{name}": _safe(name) for name in ("range", "ord", "divmod")}
    | {
        "builtins.str": _string,
        "builtins.len": _length,
        "builtins.list": _sequence,
        "builtins.set": _sequence,
        "builtins.frozenset": _sequence,
        "builtins.iter": _sequence,
        "builtins.tuple": _tuple,
        "builtins.dict": _dict,
        "builtins.map": _map,
        "builtins.filter": _filter,
        "builtins.zip": _zip,
        "builtins.enumerate": _enumerate,
        "builtins.reversed": _reversed,
        "builtins.print": _nothing,
        "builtins.open": _open,
        "builtins.isinstance": _is_instance,
    }
)
"""The functions by their name in launch files."""

_AMENT = ("ament_index_python.packages", "ament_index_python", "ament_index_python.resources")
FUNCTIONS: Mapping[str, Work] = MappingProxyType(
    {
        "os.path.join": _join,
        "os.path.abspath": _same_path,
        "os.path.realpath": _same_path,
        "os.path.normpath": _same_path,
        "os.path.expanduser": _same_path,
        "os.path.expandvars": _same_path,
        "os.getenv": _getenv,
        "os.environ.get": _getenv,
        "os.environ.setdefault": _nothing,
        "os.environ.update": _nothing,
        "os.putenv": _nothing,
        "os.getcwd": _directory,
        "pathlib.Path": _new_path,
        "pathlib.PurePath": _new_path,
        "pathlib.PosixPath": _new_path,
        "io.open": _open,
        "codecs.open": _open,
        "copy.copy": _copy,
        "copy.deepcopy": _copy,
        "functools.partial": _partial,
        "itertools.chain": _chain,
        "logging.info": _nothing,
        "logging.warning": _nothing,
        "logging.getLogger": _nothing,
        "sys.path.append": _nothing,
        "sys.path.insert": _nothing,
        "xacro.process_file": _xacro_file,
        "xacro.parse": _xacro_file,
        "xacro.process_doc": _xacro_arguments,
        "xacro.process": _xacro_text,
        "moveit_configs_utils.MoveItConfigsBuilder": moveit.builder,
        "moveit_configs_utils.moveit_configs_builder.MoveItConfigsBuilder": moveit.builder,
    }
    | dict(data_functions.FUNCTIONS)
    | {f"os.path.{name}": _path_work(name) for name in _PATH_WORKS}
    | {f"os.path.{name}": _exists for name in ("exists", "isfile", "isdir")}
    | {f"yaml.{name}": _load_yaml for name in ("safe_load", "load", "full_load")}
    | {f"{module}.get_package_share_directory": _share for module in _AMENT}
    | {f"{module}.get_package_share_path": _share_path for module in _AMENT}
    | {f"{module}.get_package_prefix": _prefix for module in _AMENT}
)
"""The values by their dotted path in imports."""
