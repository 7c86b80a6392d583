"""Methods of File: paths, and texts of the workspace."""

from __future__ import annotations

import posixpath

from checker.expand.spawner.files import expanded, folder_of, joined_path, workspace_path
from checker.expand.spawner.limits import MAX_PATH_LENGTH
from checker.expand.spawner.methods.call import Call, Methods
from checker.expand.spawner.traced import computed
from checker.expand.spawner.values import RubyArray, Value


def resolve(call: Call, path: Value) -> str:
    """Return the path in the workspace that an absolute path of Ruby means.

    Raises:
        Unreadable: It is relative to where Ruby runs, or lies outside the workspace.
    """
    text = call.text(path)
    if len(text) > MAX_PATH_LENGTH:
        raise call.refuse(f"with a path of more than {MAX_PATH_LENGTH} characters")
    found = workspace_path(text)
    if found is None:
        where = "outside the workspace" if text.startswith("/") else "relative to where Ruby runs"
        raise call.refuse(f"with a path {where}: {text[:80]}")
    return found


def _join(call: Call, *parts: Value) -> Value:
    texts: list[str] = []
    for part in parts:
        inner = part.data.items if isinstance(part.data, RubyArray) else [part]
        texts += [call.text(item) for item in inner]
    return call.run.computed(joined_path(texts), call.span, *parts)


def _dirname(call: Call, path: Value) -> Value:
    return call.run.computed(folder_of(call.text(path)), call.span, path)


def _basename(call: Call, path: Value, suffix: Value | None = None) -> Value:
    name = posixpath.basename(call.text(path).rstrip("/"))
    ending = call.text(suffix) if suffix else ""
    if ending == ".*":
        name = posixpath.splitext(name)[0]
    elif ending and name != ending:
        name = name.removesuffix(ending)
    return call.run.computed(name, call.span, path)


def _expand_path(call: Call, path: Value, folder: Value | None = None) -> Value:
    found = expanded(call.text(path), call.text(folder) if folder else None)
    if found is None:
        raise call.refuse("with a path relative to where Ruby runs")
    return call.run.computed(found, call.span, path)


def _exist(call: Call, path: Value) -> Value:
    return call.value(call.run.files.exists(resolve(call, path)), path)


def _read(call: Call, path: Value) -> Value:
    source = call.run.read(resolve(call, path), call.span)
    return call.run.string(computed(source.text, source.whole(), call.run.influences))


FILE: Methods = {
    "join": _join,
    "dirname": _dirname,
    "basename": _basename,
    "expand_path": _expand_path,
    "absolute_path": _expand_path,
    "exist?": _exist,
    "read": _read,
}
