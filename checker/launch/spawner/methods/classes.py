"""The functions of Ruby's methods, by a receiver's class and a method's name; and Kernel."""

from __future__ import annotations

import posixpath
from collections.abc import Mapping

from checker.launch.spawner.files import FILE, YAML, absolute, folder_of, resolve, workspace_path
from checker.launch.spawner.literals import TracedString
from checker.launch.spawner.methods.call import Call, Method, Methods, check_arity
from checker.launch.spawner.methods.collections import ARRAY, HASH, HASH_WITH_BLOCK
from checker.launch.spawner.methods.enumerable import (
    ENUMERABLE,
    ENUMERABLE_WITH_BLOCK,
    RANGE,
)
from checker.launch.spawner.methods.number import (
    INTEGER,
    INTEGER_WITH_BLOCK,
    MATH,
    NUMBER,
)
from checker.launch.spawner.methods.string import STRING
from checker.launch.spawner.signals import ERROR_CLASSES, RubyError, Unreadable
from checker.launch.spawner.value_text import formatted
from checker.launch.spawner.values import (
    Constant,
    RubyArray,
    RubyHash,
    RubyString,
    Value,
    class_name,
)

# Ruby's functions that need no receiver: files to load, messages, errors, formats.


_LIBRARIES = frozenset(
    {"yaml", "erb", "json", "set", "date", "time", "pathname", "fileutils", "ostruct", "pp"}
    | {"matrix", "securerandom", "shellwords", "open3", "csv", "logger", "rexml/document"}
)
"""Loading them has no effect here; what calls one is refused where it is."""


def _puts(_call: Call, *_values: Value) -> Value:
    """Ignore messages: they do not belong to what the spawner returns."""
    return None


def _raise(call: Call, error: Value = None, message: Value = None) -> Value:
    if not call.arguments:
        raise RubyError("RuntimeError", "unhandled exception", call.span)
    if isinstance(error, RubyString):
        raise RubyError("RuntimeError", error.text, call.span)
    if isinstance(error, Constant) and error.name in ERROR_CLASSES:
        text = call.text(message) if len(call.arguments) == 2 else error.name
        raise RubyError(error.name, text, call.span)
    raise call.refuse()


def _require(call: Call, name: Value) -> Value:
    text = call.text(name)
    if text in _LIBRARIES:
        return True
    if text.startswith("/"):
        return _run_once(call, resolve(call, name))
    raise Unreadable(call.span, f"requires '{text[:60]}', which is not available")


def _require_relative(call: Call, name: Value) -> Value:
    folder = folder_of(absolute(call.run.scope.path))
    target = posixpath.normpath(posixpath.join(folder, call.text(name)))
    path = workspace_path(target)
    if path is None:
        raise Unreadable(call.span, f"requires {target}, which is outside the workspace")
    return _run_once(call, path)


def _run_once(call: Call, path: str) -> Value:
    if not path.endswith(".rb"):
        path += ".rb"
    if path in call.run.loaded:
        return False
    return _run(call, path)


def _load(call: Call, path: Value) -> Value:
    return _run(call, resolve(call, path))


def _run(call: Call, path: str) -> Value:
    """Run a Ruby file; one that is missing is Ruby's LoadError, which `rescue` may catch."""
    run = call.run
    if not run.files.exists(path):
        package, inside, _ = path.partition("/")
        if inside and run.files.package_folder(package) is None and not run.files.exists(package):
            raise Unreadable(call.span, f"package {package} is not available")
        raise RubyError("LoadError", f"cannot load such file -- {absolute(path)}", call.span)
    run.run_file(path, call.span)
    return True


def _format(call: Call, template: Value, *values: Value) -> Value:
    return formatted(call, template, list(values))


KERNEL: Methods = {
    "format": _format,
    "load": _load,
    "print": _puts,
    "puts": _puts,
    "raise": _raise,
    "require": _require,
    "require_relative": _require_relative,
    "sprintf": _format,
    "warn": _puts,
}


def invoke_method(call: Call) -> Value:
    """Answer a method call.

    Raises:
        Unreadable: The method is not in the whitelist.
        RubyError: Ruby refuses the call.
    """
    data, tables = call.receiver, _METHODS if call.block is None else _WITH_BLOCK
    name = f"{data.name}." if isinstance(data, Constant) else class_name(data)
    common = () if call.block or isinstance(data, Constant) else (_COMMON,)
    for methods in (*tables.get(name, ()), *common):
        method: Method | None = methods.get(call.name)
        if method is not None:
            check_arity(call, method)
            return method(call, *call.arguments)
    raise call.refuse()


def _to_s(call: Call) -> Value:
    if isinstance(call.receiver, RubyString):
        return call.receiver
    return call.run.string(call.run.written(call.receiver, call.span))


def _dup(call: Call) -> Value:
    data = call.receiver
    if isinstance(data, RubyString):
        return RubyString(data.content)
    if isinstance(data, RubyArray):
        return call.run.array(list(data.items))
    if isinstance(data, RubyHash):
        call.run.budget.spend_items(len(data.entries))
        return RubyHash(dict(data.entries), data.default)
    return call.receiver


def _freeze(call: Call) -> Value:
    data = call.receiver
    if isinstance(data, (RubyString, RubyArray, RubyHash)):
        data.frozen = True
    return call.receiver


def _is_a(call: Call, ruby_class: Value) -> Value:
    if not isinstance(ruby_class, Constant) or ruby_class.name in ERROR_CLASSES:
        raise call.refuse()
    name, own = ruby_class.name, class_name(call.receiver)
    return name == own or (name == "Numeric" and own in {"Integer", "Float"})


_COMMON: Methods = {
    "dup": _dup,
    "freeze": _freeze,
    "is_a?": _is_a,
    "nil?": lambda call: call.receiver is None,
    "to_s": _to_s,
}

_METHODS: Mapping[str, tuple[Methods, ...]] = {
    "String": (STRING,),
    "Array": (ARRAY, ENUMERABLE),
    "Hash": (HASH, ENUMERABLE),
    "Range": (RANGE, ENUMERABLE),
    "Integer": (INTEGER,),
    "Float": (NUMBER,),
    "Exception": ({"message": _to_s},),
    "File.": (FILE,),
    "YAML.": (YAML,),
    "Math.": (MATH,),
    "String.": ({"new": lambda call: call.run.string(TracedString())},),
    "Array.": ({"new": lambda call: call.run.array([])},),
    "Hash.": ({"new": lambda _call, default=None: RubyHash(default=default)},),
}
"""A class with a dot represents its own methods."""

_WITH_BLOCK: Mapping[str, tuple[Methods, ...]] = {
    "Array": (ENUMERABLE_WITH_BLOCK,),
    "Hash": (HASH_WITH_BLOCK,),
    "Range": (ENUMERABLE_WITH_BLOCK,),
    "Integer": (INTEGER_WITH_BLOCK,),
}
"""Methods that take a block are in separate tables."""
