"""Ruby's functions that need no receiver: files to load, messages, errors, formats."""

from __future__ import annotations

import posixpath

from checker.expand.spawner.files import absolute, folder_of, resolve, workspace_path
from checker.expand.spawner.methods.call import Call, Methods
from checker.expand.spawner.signals import ERROR_CLASSES, RubyError, Unreadable
from checker.expand.spawner.value_text import formatted
from checker.expand.spawner.values import NIL, Constant, RubyString, Value

_LIBRARIES = frozenset(
    {"yaml", "erb", "json", "set", "date", "time", "pathname", "fileutils", "ostruct", "pp"}
    | {"matrix", "securerandom", "shellwords", "open3", "csv", "logger", "rexml/document"}
)
"""Loading them has no effect here; what calls one is refused where it stands."""


def _puts(_call: Call, *_values: Value) -> Value:
    """Ignore messages: they do not belong to what the spawner returns."""
    return NIL


def _raise(call: Call, error: Value | None = None, message: Value | None = None) -> Value:
    if error is None:
        raise RubyError("RuntimeError", "unhandled exception", call.span)
    data = error.data
    if isinstance(data, RubyString):
        raise RubyError("RuntimeError", data.text, call.span)
    if isinstance(data, Constant) and data.name in ERROR_CLASSES:
        raise RubyError(data.name, call.text(message) if message else data.name, call.span)
    raise call.refuse()


def _require(call: Call, name: Value) -> Value:
    text = call.text(name)
    if text in _LIBRARIES:
        return call.run.value(True)
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
            raise Unreadable(call.span, f"package {package} is not available")
        raise RubyError("LoadError", f"cannot load such file -- {absolute(path)}", call.span)
    run.run_file(path, call.span)
    return run.value(True)


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
