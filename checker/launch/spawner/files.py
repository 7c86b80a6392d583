"""Files that a spawner may read: those of the workspace, through the caller's loader only.

Ruby sees the workspace as the folder `/workspace`; no other folder exists.
"""

from __future__ import annotations

import posixpath
from typing import TYPE_CHECKING, Any, Protocol

from checker.launch.spawner.limits import (
    MAX_FILE_LENGTH,
    MAX_INTEGER_BITS,
    MAX_NUMBER_LENGTH,
    MAX_PATH_LENGTH,
)
from checker.launch.spawner.literals import computed_string
from checker.launch.spawner.methods.call import Call, Methods
from checker.launch.spawner.values import RubyArray, RubyHash, RubyString, Value, key_of
from checker.source.text import SourceText, Span

if TYPE_CHECKING:
    import yaml

ROOT = "/workspace"
_MAX_NESTING = 40


class SpawnerFiles(Protocol):
    """Gives texts of the workspace; paths are relative to it, normalised, with `/`."""

    def read(self, path: str) -> SourceText | str:
        """Return a text, or the reason why it cannot be given."""
        ...

    def exists(self, path: str) -> bool:
        """Return whether there is a file or folder of this path, text or not."""
        ...

    def package_folder(self, name: str) -> str | None:
        """Return the folder of a package, or None if the package is not available."""
        ...


def absolute(path: str) -> str:
    """Return the path under which Ruby sees a file of the workspace."""
    return posixpath.normpath(posixpath.join(ROOT, path))


def workspace_path(path: str) -> str | None:
    """Return the path relative to the workspace of an absolute path, or None outside it."""
    if not path.startswith("/"):
        return None
    clean = posixpath.normpath(path)
    return clean[len(ROOT) + 1 :] if clean.startswith(ROOT + "/") else None


def folder_of(path: str) -> str:
    """Return the folder as `File.dirname` does."""
    folder = posixpath.dirname(path.rstrip("/") or path)
    return folder or "."


def resolve(call: Call, path: Value) -> str:
    """Return the path in the workspace that an absolute path of Ruby means.

    Raises:
        Unreadable: It is relative to where Ruby runs, or is outside the workspace.
    """
    text = call.text(path)
    if len(text) > MAX_PATH_LENGTH:
        raise call.refuse(f"with a path of more than {MAX_PATH_LENGTH} characters")
    name = workspace_path(text)
    if name is None:
        where = "outside the workspace" if text.startswith("/") else "relative to where Ruby runs"
        raise call.refuse(f"with a path {where}: {text[:80]}")
    return name


def _join(call: Call, first: Value, *others: Value) -> Value:
    """Join with one `/` between the parts, and keep `..`."""
    path = call.text(first)
    for other in others:
        part = call.text(other)
        if path.endswith("/"):
            path = path.rstrip("/") + "/" if part.startswith("/") else path
            path += part.lstrip("/")
        else:
            path += part if part.startswith("/") else f"/{part}"
    return call.run.computed(path, call.span)


def _dirname(call: Call, path: Value) -> Value:
    return call.run.computed(folder_of(call.text(path)), call.span)


def _basename(call: Call, path: Value) -> Value:
    name = posixpath.basename(call.text(path).rstrip("/"))
    return call.run.computed(name, call.span)


def _expand_path(call: Call, path: Value, folder: Value = None) -> Value:
    text = call.text(path)
    if folder is not None and not text.startswith(("/", "~")):
        text = f"{call.text(folder)}/{text}"
    if not text.startswith("/"):
        raise call.refuse("with a path relative to where Ruby runs")
    return call.run.computed("/" + posixpath.normpath(text).lstrip("/"), call.span)


def _exist(call: Call, path: Value) -> Value:
    return call.run.files.exists(resolve(call, path))


def _read(call: Call, path: Value) -> Value:
    source = call.run.read(resolve(call, path), call.span)
    return call.run.string(computed_string(source.text, source.whole()))


FILE: Methods = {
    "join": _join,
    "dirname": _dirname,
    "basename": _basename,
    "expand_path": _expand_path,
    "exist?": _exist,
    "read": _read,
}


def _load_file(call: Call, path: Value) -> Value:
    return _parsed(call, call.run.read(resolve(call, path), call.span))


def _load(call: Call, text: Value) -> Value:
    """Read a text; one that `File.read` gave keeps its places in the file."""
    content = call.traced(text)
    if len(content.pieces) == 1 and not content.pieces[0].literal and content.pieces[0].span:
        source = content.pieces[0].span.source
        if source.text == content.text:
            return _parsed(call, source)
    return _parsed(call, SourceText(call.node.source.file, content.text), call.span)


def _parsed(call: Call, source: SourceText, span: Span | None = None) -> Value:
    """Read a YAML text.

    Args:
        call: The call that reads it.
        source: The text.
        span: The origin of all strings, when `source` is no file.
    """
    import yaml

    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    if len(source.text) > MAX_FILE_LENGTH:
        raise call.refuse(f"but {source.file} is longer than {MAX_FILE_LENGTH} characters")
    call.run.budget.spend_parsing(len(source.text))
    try:
        _check_events(call, source, yaml.parse(source.text, Loader=loader))
        node = yaml.compose(source.text, Loader=loader)
        if node is None:
            return False
        return _yaml_value(call, node, source, span, yaml.SafeLoader(""))
    except (yaml.YAMLError, ValueError, OverflowError) as error:
        where = getattr(error, "problem_mark", None)
        line = f" in line {where.line + 1}" if where else ""
        raise call.refuse(f"but {source.file} is not YAML that can be read{line}") from None


def _check_events(call: Call, source: SourceText, events: Any) -> None:
    """Refuse aliases (as Ruby does) and deep nesting before anything is built."""
    import yaml

    depth = 0
    for event in events:
        if isinstance(event, yaml.AliasEvent):
            raise call.refuse(f"but {source.file} uses an alias (*{event.anchor})")
        depth += isinstance(event, yaml.CollectionStartEvent)
        depth -= isinstance(event, yaml.CollectionEndEvent)
        if depth > _MAX_NESTING:
            raise call.refuse(f"but {source.file} is nested too deeply")


def _yaml_value(
    call: Call, node: yaml.Node, source: SourceText, span: Span | None, maker: yaml.SafeLoader
) -> Value:
    import yaml

    call.run.budget.spend()
    if isinstance(node, yaml.SequenceNode):
        items = [_yaml_value(call, item, source, span, maker) for item in node.value]
        return RubyArray(items)
    if isinstance(node, yaml.MappingNode):
        result = RubyHash()
        for pair in node.value:
            key, value = (_yaml_value(call, part, source, span, maker) for part in pair)
            result.entries[key_of(key, call.run.budget)] = (key, value)
        return result
    if len(node.value) > MAX_NUMBER_LENGTH and not node.tag.endswith(":str"):
        raise call.refuse(f"but {source.file} contains a number that is too long")
    data = maker.construct_object(node)
    if isinstance(data, str):
        here = span or Span(source, node.start_mark.index, node.end_mark.index)
        return RubyString(computed_string(data, here))
    if isinstance(data, int) and data.bit_length() > MAX_INTEGER_BITS:
        raise call.refuse(f"but {source.file} contains an integer that is too large")
    if data is not None and not isinstance(data, (bool, int, float)):
        raise call.refuse(f"but {source.file} contains a value of the type {node.tag}")
    return data


YAML: Methods = {
    "load_file": _load_file,
    "safe_load_file": _load_file,
    "load": _load,
    "safe_load": _load,
}
