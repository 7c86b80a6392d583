"""Ruby's functions that need no receiver: files to load, messages, errors, conversions."""

from __future__ import annotations

import posixpath

from checker.expand.spawner.files import absolute, folder_of, workspace_path
from checker.expand.spawner.methods.call import Call, Methods
from checker.expand.spawner.methods.conversion import whole_float, whole_number
from checker.expand.spawner.methods.file import resolve
from checker.expand.spawner.methods.format import formatted
from checker.expand.spawner.ruby_errors import ERROR_CLASSES
from checker.expand.spawner.signals import RubyError, Unreadable
from checker.expand.spawner.values import (
    NIL,
    Constant,
    ErrorValue,
    RubyString,
    Value,
    is_number,
)

_LIBRARIES = frozenset(
    {"yaml", "psych", "erb", "json", "set", "date", "time", "pathname", "fileutils", "ostruct"}
    | {"bigdecimal", "matrix", "securerandom", "shellwords", "open3", "tempfile", "csv", "logger"}
    | {"rexml/document", "optparse", "forwardable", "singleton", "stringio", "tmpdir", "pp"}
    | {"English", "rbconfig", "digest", "uri", "benchmark", "timeout"}
)


def _puts(_call: Call, *_values: Value) -> Value:
    """Ignore messages: they do not belong to what the spawner returns."""
    return NIL


def _raise(call: Call, error: Value | None = None, message: Value | None = None) -> Value:
    if error is None:
        raise RubyError("RuntimeError", "unhandled exception", call.span)
    data = error.data
    if isinstance(data, RubyString):
        raise RubyError("RuntimeError", data.text, call.span)
    if isinstance(data, ErrorValue):
        raise RubyError(data.kind, data.message, call.span)
    if isinstance(data, Constant) and data.name in ERROR_CLASSES:
        raise RubyError(data.name, call.text(message) if message else data.name, call.span)
    raise call.refuse()


def _require(call: Call, name: Value) -> Value:
    text = call.text(name)
    if text in _LIBRARIES:
        return call.run.value(True)
    if text.startswith("/"):
        return _run_once(call, resolve(call, name))
    raise Unreadable(call.span, f"requires '{text[:60]}', which is not at hand")


def _require_relative(call: Call, name: Value) -> Value:
    folder = folder_of(absolute(call.run.scope.path))
    target = posixpath.normpath(posixpath.join(folder, call.text(name)))
    path = workspace_path(target)
    if path is None:
        raise Unreadable(call.span, f"requires {target}, which lies outside the workspace")
    return _run_once(call, path)


def _run_once(call: Call, path: str) -> Value:
    if not path.endswith(".rb"):
        path += ".rb"
    if path in call.run.loaded:
        return call.run.value(False)
    return _run(call, path)


def _load(call: Call, path: Value) -> Value:
    return _run(call, resolve(call, path))


def _run(call: Call, path: str) -> Value:
    """Run a Ruby file; one that is missing is Ruby's LoadError, which `rescue` may catch."""
    run = call.run
    if not run.files.exists(path):
        package, inside, _ = path.partition("/")
        if inside and run.files.package_folder(package) is None and not run.files.exists(package):
            raise Unreadable(call.span, f"package {package} is not at hand")
        raise RubyError("LoadError", f"cannot load such file -- {absolute(path)}", call.span)
    run.run_file(path, call.span)
    return run.value(True)


def _format(call: Call, template: Value, *values: Value) -> Value:
    return formatted(call, template, list(values))


def _to_float(call: Call, value: Value) -> Value:
    if is_number(value):
        return call.run.value(float(call.number(value)), value)
    number = whole_float(call.text(value))
    if number is None:
        text = f'invalid value for Float(): "{call.text(value)}"'
        raise RubyError("ArgumentError", text, call.span)
    return call.run.value(number, value)


def _to_integer(call: Call, value: Value) -> Value:
    if is_number(value):
        return call.run.value(call.whole(call.number(value)), value)
    number = whole_number(call.text(value))
    if number is None:
        raise call.refuse("with a text that is no plain integer")
    return call.run.value(number, value)


def _to_string(call: Call, value: Value) -> Value:
    return call.run.string(call.run.written(value, call.span))


def _block_given(call: Call) -> Value:
    return call.run.value(call.run.scope.call.block is not None)


def _loop(call: Call) -> Value:
    while True:
        call.run.budget.spend()
        call.each()


KERNEL: Methods = {
    "puts": _puts,
    "print": _puts,
    "warn": _puts,
    "raise": _raise,
    "fail": _raise,
    "require": _require,
    "require_relative": _require_relative,
    "load": _load,
    "format": _format,
    "sprintf": _format,
    "Float": _to_float,
    "Integer": _to_integer,
    "String": _to_string,
    "block_given?": _block_given,
    "loop": _loop,
}
