"""Functions of Python, of its library and of ROS that launch files call."""

from __future__ import annotations

import ast
import posixpath
import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from types import MappingProxyType
from typing import TYPE_CHECKING

from checker.formats.xacro.expression.builtins import FUNCTIONS as SAFE
from checker.formats.xacro.files import ROOT
from checker.launch.ros2.graph import is_known
from checker.launch.ros2.python import data_functions, moveit, moveit_launches
from checker.launch.ros2.python.call import Call, NotKnown, Work
from checker.launch.ros2.python.expressions import bounded, hashable, plain
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
)
from checker.source.yaml import read_yaml

if TYPE_CHECKING:
    from checker.launch.ros2.python.interpreter import Interpreter

CONSTANTS: Mapping[str, str | float] = MappingProxyType(
    {"os.sep": "/", "os.path.sep": "/", "os.pathsep": ":", "os.linesep": "\n"}
    | dict(data_functions.CONSTANTS)
)
PREFIX = f"{ROOT}-prefix"
"""The folder of the install prefixes of packages."""


# Paths.


def _join(call: Call) -> Value:
    parts = call.texts(call.arguments)
    if not parts:
        return call.unknown("os.path.join joins nothing")
    call.run.allowance.spend_on_text(sum(map(len, parts)))
    return call.placed(posixpath.join(*map(str, parts)))


_PATH_WORKS: Mapping[str, Callable[[str], str | tuple[str, str]]] = MappingProxyType(
    {
        "dirname": posixpath.dirname,
        "basename": posixpath.basename,
        "splitext": posixpath.splitext,
        "split": posixpath.split,
        "abspath": posixpath.normpath,
        "realpath": posixpath.normpath,
        "normpath": posixpath.normpath,
        "expanduser": posixpath.normpath,
        "expandvars": posixpath.normpath,
    }
)


def _path_work(name: str) -> Work:
    def work(call: Call) -> Value:
        result = _PATH_WORKS[name](str(call.text(call.first("path", "filename"))))
        return tuple(map(call.placed, result)) if isinstance(result, tuple) else call.placed(result)

    return work


def _exists(call: Call) -> Value:
    call.run.by_argument = True
    with suppress(NotKnown):
        there = call.run.world.exists(str(call.text(call.first("path"))))
        if there is not None:
            return there
    return call.unknown("whether the file exists is not known")


def _share(call: Call) -> PlacedText:
    return _package_folder(call, ROOT)


def _share_path(call: Call) -> Value:
    return FilePath(str(_share(call)))


def _prefix(call: Call) -> Value:
    return _package_folder(call, PREFIX)


def _package_folder(call: Call, folder: str) -> PlacedText:
    name = call.text(call.first("package_name"))
    if not is_known(name):
        raise call.not_known("the name of the package is not known")
    return call.placed(f"{folder}/{name}")


def _new_path(call: Call) -> Value:
    return call.run.joined_path(call.arguments, call.node)


def _directory(call: Call) -> Value:
    call.run.by_argument = True
    return call.placed("$(env PWD)")


def _directory_path(call: Call) -> Value:
    return FilePath(str(_directory(call)))


# Files.


def _open(call: Call) -> Value:
    return OpenFile(str(call.text(call.first("file"))))


def _load_yaml(call: Call) -> Value:
    content = chosen_value(call.first("stream"))
    if isinstance(content, OpenFile | FileText):
        return _yaml_file(call, content.path)
    return content if isinstance(content, Unknown) else call.unknown("the YAML is not known")


def _yaml_file(call: Call, path: str) -> Value:
    """Return what a YAML file contains."""
    run = call.run
    run.by_argument = True
    source = run.world.read(path, call.span)
    if isinstance(source, str):
        return call.unknown(source)
    run.allowance.spend_on_text(min(len(source.text), 90_000))
    root = read_yaml(source).root
    if root is None:
        return call.unknown(f"{source.file} cannot be read")
    run.allowance.spend(root.size)
    return root.plain()


# xacro, called from Python.


def _xacro_file(call: Call) -> Made:
    file = chosen_value(call.first("input_file_name", "input", "filename"))
    path = file.path if isinstance(file, OpenFile) else call.text(file)
    values = {"path": str(path), "mappings": call.named.get("mappings")}
    return Made("XacroDocument", values, call.span)


def _xacro_arguments(call: Call) -> Value:
    document, named = chosen_value(call.first("doc")), call.named
    if isinstance(document, Made) and document.name == "XacroDocument" and "mappings" in named:
        document.values["mappings"] = named["mappings"]
    return None


def _xacro_text(call: Call) -> Value:
    return xacro_text(call.run, _xacro_file(call), call.node)


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


_MARKUP = re.compile(r"<(?:!--|\?xml\b)")


def _substituted(call: Call) -> Value:
    """Return the text of a robot without its comments: it describes the same robot."""
    values = dict(zip(("pattern", "repl", "string"), call.arguments, strict=False)) | call.named
    pattern, text = call.text(values.get("pattern")), call.text(values.get("string"))
    if _MARKUP.match(pattern.lstrip("\\")) and not is_known(text):
        return text
    return call.unknown("re.sub is not evaluated")


def _getenv(call: Call) -> Value:
    default = call.arguments[1] if len(call.arguments) > 1 else call.named.get("default")
    return call.run.environment(call.first("key"), default, call.node)


def _partial(call: Call) -> Value:
    if not call.arguments:
        return call.unknown("partial() of nothing")
    return Partial(call.arguments[0], call.arguments[1:], call.named)


def _copy(call: Call) -> Value:
    value = chosen_value(call.first())
    call.run.allowance.spend(len(value) if isinstance(value, list | dict) else 1)
    return value.copy() if isinstance(value, list | dict) else value


def _nothing(_: Call) -> Value:
    return None


def _sequence(call: Call) -> list[Value]:
    return call.items(call.arguments[0]) if call.arguments else []


def _dict(call: Call) -> Value:
    entries: dict[Value, Value] = {}
    if call.arguments:
        given = chosen_value(call.arguments[0])
        if isinstance(given, dict):
            entries |= given
        else:
            for pair in call.items(given):
                if not isinstance(pair, tuple | list) or len(pair) != 2:
                    return call.unknown("the items are not known")
                key = hashable(call.run, pair[0], call.node)
                if isinstance(key, Unknown):
                    return key
                entries[key] = pair[1]
    return entries | call.named


def _map(call: Call) -> Value:
    if len(call.arguments) < 2:
        return call.unknown("map() takes a function and items")
    columns = map(call.items, call.arguments[1:])
    return [_applied(call, list(row)) for row in zip(*[*columns], strict=False)]


def _applied(call: Call, arguments: list[Value]) -> Value:
    """Return what the function that is the first argument returns."""
    return call.run.called(chosen_value(call.arguments[0]), arguments, {}, call.node)


def _zip(call: Call) -> Value:
    return [*zip(*map(call.items, call.arguments), strict=False)]


def _enumerate(call: Call) -> Value:
    start = call.arguments[1] if len(call.arguments) > 1 else call.named.get("start", 0)
    return [*enumerate(_sequence(call), start if type(start) is int else 0)]


def _chain(call: Call) -> Value:
    return [item for argument in call.arguments for item in call.items(argument)]


def _filter(call: Call) -> Value:
    if len(call.arguments) != 2:
        return call.unknown("filter() takes a function and items")
    kept = []
    for item in call.items(call.arguments[1]):
        keeps = item if call.arguments[0] is None else _applied(call, [item])
        if call.run.truth(keeps) is not False:
            kept.append(item)
    return kept


def _string(call: Call) -> Value:
    value = chosen_value(call.arguments[0]) if call.arguments else ""
    if isinstance(value, str | FilePath | Made | Unknown):
        return call.text(value)
    return bounded(call.run, call.node, lambda budget: SAFE["str"].work(budget, plain(value)))


def _length(call: Call) -> Value:
    value = chosen_value(call.first())
    if isinstance(value, list | tuple | dict) and not any(
        isinstance(item, Guarded | Choice | Unknown) for item in value
    ):
        return len(value)
    return bounded(call.run, call.node, lambda budget: SAFE["len"].work(budget, plain(value)))


def _is_instance(call: Call) -> Value:
    names = {"str": str, "int": int, "float": float, "bool": bool, "list": list, "dict": dict}
    classes = call.arguments[1] if len(call.arguments) == 2 else ()
    kinds = classes if isinstance(classes, tuple) else (classes,)
    if kinds and all(isinstance(kind, Symbol) and kind.last in names for kind in kinds):
        value = chosen_value(call.arguments[0])
        if not isinstance(value, Unknown):
            return isinstance(value, tuple(names[kind.last] for kind in kinds))
    return call.unknown("isinstance() is not evaluated")


def _safe(name: str) -> Work:
    def work(call: Call) -> Value:
        named = call.named
        if any(isinstance(value, LocalFunction) for value in named.values()):
            return call.unknown(f"{name}() with a function is not evaluated")
        return bounded(
            call.run,
            call.node,
            lambda budget: _as_sequence(
                SAFE[name].work(
                    budget,
                    *map(plain, call.arguments),
                    **{key: plain(value) for key, value in named.items()},
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
        "builtins.tuple": lambda call: tuple(_sequence(call)),
        "builtins.dict": _dict,
        "builtins.map": _map,
        "builtins.filter": _filter,
        "builtins.zip": _zip,
        "builtins.enumerate": _enumerate,
        "builtins.reversed": lambda call: _sequence(call)[::-1],
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
        "os.getenv": _getenv,
        "os.environ.get": _getenv,
        "os.environ.setdefault": _nothing,
        "os.environ.update": _nothing,
        "os.putenv": _nothing,
        "os.getcwd": _directory,
        "pathlib.Path.cwd": _directory_path,
        "pathlib.Path": _new_path,
        "pathlib.PurePath": _new_path,
        "pathlib.PosixPath": _new_path,
        "io.open": _open,
        "codecs.open": _open,
        "re.sub": _substituted,
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
    | dict(moveit_launches.FUNCTIONS)
    | {f"os.path.{name}": _path_work(name) for name in _PATH_WORKS}
    | {f"os.path.{name}": _exists for name in ("exists", "isfile", "isdir", "lexists")}
    | {"os.access": _exists}
    | {f"yaml.{name}": _load_yaml for name in ("safe_load", "load", "full_load")}
    | {f"{module}.get_package_share_directory": _share for module in _AMENT}
    | {f"{module}.get_package_share_path": _share_path for module in _AMENT}
    | {f"{module}.get_package_prefix": _prefix for module in _AMENT}
)
"""The values by their dotted path in imports."""
