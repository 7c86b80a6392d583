"""Attributes and methods of values in launch files."""

from __future__ import annotations

import ast
import posixpath
from functools import partial
from typing import TYPE_CHECKING

from checker.formats.xacro.expression.methods import method_of
from checker.launch.ros2.classes import SUBSTITUTIONS
from checker.launch.ros2.graph import is_known
from checker.launch.ros2.python import library, moveit
from checker.launch.ros2.python.call import Call
from checker.launch.ros2.python.expressions import bounded, each, hashable, plain
from checker.launch.ros2.python.scope import Method
from checker.launch.ros2.values import (
    FilePath,
    FileText,
    Made,
    OpenFile,
    PlacedText,
    Unknown,
    Value,
    chosen_value,
)

if TYPE_CHECKING:
    from checker.launch.ros2.python.interpreter import Interpreter

CONTEXT = "LaunchContext"
_WHOLE = ("$(file-content ", "$(command ")
"""Texts of a whole file: `FileText` and the output of xacro."""
_OF_PATHS = {"name": "basename", "parent": "dirname"}


def attribute(run: Interpreter, owner: Value, name: str, node: ast.AST) -> Value:
    """Return `owner.name`: a part of it, or a method."""
    if isinstance(owner, FilePath):
        return _of_path(owner, name, run, node)
    if isinstance(owner, Made):
        if owner.name == "MoveItConfigs" and name not in ("to_dict", "to_moveit_configs"):
            # Until they are built, the parameters are methods.
            built = "built" in owner.values
            return moveit.parameters(run, owner, name) if built else Method(owner, name)
        if name in owner.values and name != "package":
            return owner.values[name]
        if owner.name == CONTEXT and name in ("launch_configurations", "environment"):
            return Made(name, {}, run.span(node))
    return Method(owner, name)


def set_attribute(owner: Value, name: str, value: Value) -> bool:
    """Assign to `owner.name`; return whether that is evaluated."""
    if not isinstance(owner, Made) or owner.name != "MoveItConfigs":
        return False
    moveit.assign(owner, name, value)
    return True


def _of_path(path: FilePath, name: str, run: Interpreter, node: ast.AST) -> Value:
    if name == "parent":
        return FilePath(posixpath.dirname(path.text))
    if name == "name":
        return PlacedText(posixpath.basename(path.text), run.span(node))
    if name in ("stem", "suffix"):
        stem, suffix = posixpath.splitext(posixpath.basename(path.text))
        return PlacedText(stem if name == "stem" else suffix, run.span(node))
    if name == "parents":
        above = [posixpath.dirname(path.text)]
        while above[-1] not in ("", "/") and len(above) < 50:
            above.append(posixpath.dirname(above[-1]))
        return [FilePath(folder) for folder in above]
    return Method(path, name)


def item(run: Interpreter, owner: Made, key: Value, node: ast.AST) -> Value:
    """Return `owner[key]` of an object of the launch system."""
    if owner.name in ("launch_configurations", "environment") and isinstance(key, str):
        run.by_argument = True
        if owner.name == "environment":
            return run.environment(key, None, node)
        value = run.world.configuration(str(key))
        return run.unknown(node, f"argument {key!r} has no value") if value is None else value
    return run.unknown(node, "the item is not evaluated")


def call(  # noqa: PLR0911 - one per method
    run: Interpreter,
    owner: Value,
    name: str,
    positional: list[Value],
    named: dict[str, Value],
    node: ast.AST,
) -> Value:
    """Return what `owner.name(…)` returns."""
    match owner:
        case list():
            return _of_list(run, owner, name, positional, node)
        case dict():
            return _of_dict(run, owner, name, positional, named, node)
        case OpenFile() if name in ("read", "close", "readlines"):
            return FileText.read(owner.path, run.span(node)) if name == "read" else None
        case FileText() if name == "replace" and not _adds(positional):
            return owner.replaced()  # the robot is judged as it is written
        case str() if owner.startswith(_WHOLE) and (
            name == "strip" or (name == "replace" and not _adds(positional))
        ):
            return owner
        case FilePath():
            return _on_path(run, owner, name, positional, node)
        case Made():
            return _of_made(run, owner, name, positional, named, node)
        case str():
            return _of_text(run, owner, name, positional, named, node)
    return run.unknown(node, f"{name}() is not evaluated")


def _adds(positional: list[Value]) -> bool:
    """Return whether what replaces a text may add elements to the file."""
    return any(isinstance(text, str) and "<" in text for text in positional[1:])


def _of_list(  # noqa: PLR0911 - one per method
    run: Interpreter, owner: list[Value], name: str, positional: list[Value], node: ast.AST
) -> Value:
    run.allowance.spend(len(owner) // 16 + 1)
    match name, positional:
        case "append", [value]:
            owner += run.guarded([value])
            return None
        case "extend", [values]:
            owner += run.guarded(each(run, values, node))
            return None
        case "insert", [int(index), value]:
            owner[index:index] = run.guarded([value])
            return None
        case "copy", []:
            return [*owner]
        case "pop", [] if owner and not run.guards:
            return owner.pop()
        case "reverse", []:
            owner.reverse()
            return None
    return bounded(
        run,
        node,
        lambda budget: method_of(plain(owner), name)(budget, plain(owner), *map(plain, positional)),
    )


def _of_dict(  # noqa: C901, PLR0911 - one per method
    run: Interpreter,
    owner: dict[Value, Value],
    name: str,
    positional: list[Value],
    named: dict[str, Value],
    node: ast.AST,
) -> Value:
    run.allowance.spend(len(owner) // 16 + 1)
    match name, positional:
        case "items", []:
            return [*owner.items()]
        case "keys", []:
            return [*owner]
        case "values", []:
            return [*owner.values()]
        case "copy", []:
            return dict(owner)
        case "get" | "pop" | "setdefault", [key, *default]:
            key = hashable(run, key, node)
            if isinstance(key, Unknown):
                return key
            value = owner.get(key, default[0] if default else None)
            if name == "pop":
                owner.pop(key, None)
            elif name == "setdefault":
                owner[key] = value
            return value
        case "update", others if not run.guards:
            for other in map(chosen_value, others):
                pairs = Call(run, node, [other], {}).evaluated(library.BUILTINS["builtins.dict"])
                if not isinstance(pairs, dict):
                    return pairs
                owner |= pairs
            owner |= named
            return None
    return run.unknown(node, f"{name}() is not evaluated")


def _on_path(  # noqa: PLR0911 - one per method
    run: Interpreter, path: FilePath, name: str, positional: list[Value], node: ast.AST
) -> Value:
    match name:
        case "resolve" | "absolute" | "expanduser":
            return FilePath(posixpath.normpath(path.text))
        case "as_posix" | "__str__" | "__fspath__":
            return PlacedText(path.text, run.span(node))
        case "joinpath":
            return run.joined_path([path, *positional], node)
        case "read_text":
            return FileText.read(path.text, run.span(node))
        case "open":
            return OpenFile(path.text)
        case "is_absolute" if is_known(path.text):
            return posixpath.isabs(path.text)
        case "exists" | "is_file" | "is_dir":
            return Call(run, node, [path], {}).evaluated(library.FUNCTIONS["os.path.exists"])
        case "with_suffix" | "with_name" if positional and isinstance(positional[0], str):
            folder, file = posixpath.split(path.text)
            stem = posixpath.splitext(file)[0] if name == "with_suffix" else ""
            return FilePath(posixpath.join(folder, stem + str(positional[0])))
    return run.unknown(node, f"{name}() of a path is not evaluated")


def _of_made(  # noqa: PLR0911 - one per method
    run: Interpreter,
    owner: Made,
    name: str,
    positional: list[Value],
    named: dict[str, Value],
    node: ast.AST,
) -> Value:
    if owner.name == "MoveItConfigs":
        return moveit.called(run, owner, name, positional, named)
    if name in ("add_action", "add_entity") and owner.name == "LaunchDescription":
        entities = owner.values.get("initial_entities")
        if not isinstance(entities, list):
            entities = [] if entities is None else each(run, entities, node)
        owner.values["initial_entities"] = [*entities, *run.guarded(positional)]
        run.allowance.spend(len(entities) // 16 + 1)
        return None
    if owner.name == "XacroDocument" and name in ("toxml", "toprettyxml"):
        return library.xacro_text(run, owner, node)
    if name == "perform" and owner.name in SUBSTITUTIONS:
        run.by_argument = True
        return run.world.perform(owner, run.span(node))
    if name == "evaluate" and owner.name in ("IfCondition", "UnlessCondition"):
        run.by_argument = True
        return _condition(run, owner, node)
    if name == "find" and owner.name == "FindPackageShare" and positional:
        share = library.FUNCTIONS["ament_index_python.get_package_share_directory"]
        return Call(run, node, positional, {}).evaluated(share)
    if owner.name == CONTEXT and name == "perform_substitution" and positional:
        run.by_argument = True
        return run.world.perform(positional[0], run.span(node))
    if owner.name == "launch_configurations" and name == "get" and positional:
        run.by_argument = True
        value = run.world.configuration(str(chosen_value(positional[0])))
        return (positional[1] if len(positional) > 1 else None) if value is None else value
    return run.unknown(node, f"{name}() of {owner.name} is not evaluated")


def _condition(run: Interpreter, condition: Made, node: ast.AST) -> Value:
    text = run.world.perform(condition.values.get("predicate_expression"), run.span(node))
    if isinstance(text, Unknown) or not is_known(text):
        return run.unknown(node, "the condition is not known")
    return (str(text).strip().lower() in ("true", "1")) is (condition.name == "IfCondition")


def _of_text(
    run: Interpreter,
    text: str,
    name: str,
    positional: list[Value],
    named: dict[str, Value],
    node: ast.AST,
) -> Value:
    if name == "join" and positional:
        return Call(run, node, positional, {}).evaluated(partial(_joined, text))
    return bounded(
        run,
        node,
        lambda budget: method_of(plain(text), name)(
            budget,
            plain(text),
            *map(plain, positional),
            **{key: plain(value) for key, value in named.items()},
        ),
    )


def _joined(text: str, call: Call) -> Value:
    parts = call.texts(call.items(call.arguments[0]))
    call.run.allowance.spend_on_text(sum(map(len, parts)) + len(text) * len(parts))
    return call.placed(text.join(map(str, parts)))
