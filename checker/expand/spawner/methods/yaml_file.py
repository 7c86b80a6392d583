"""YAML files: plain scalars, lists and maps, each string with its place."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from checker.expand.spawner.limits import (
    MAX_FILE_LENGTH,
    MAX_INTEGER_BITS,
    MAX_NUMBER_LENGTH,
)
from checker.expand.spawner.methods.call import Call, Methods
from checker.expand.spawner.methods.file import resolve
from checker.expand.spawner.traced import Piece, TracedString
from checker.expand.spawner.values import RubyArray, RubyHash, RubyString, Value, key_of
from checker.source.text import SourceText, Span

if TYPE_CHECKING:
    import yaml

_MAX_NESTING = 40


def _load_file(call: Call, path: Value) -> Value:
    return _parse(call, call.run.read(resolve(call, path), call.span))


def _load(call: Call, text: Value) -> Value:
    content = call.traced(text)
    pieces = content.pieces
    if len(pieces) == 1 and pieces[0].span is not None and not pieces[0].literal:
        source = pieces[0].span.source
        if source.text == content.text:
            return _parse(call, source)
    return _parse(call, SourceText(call.node.source.file, content.text), call.span)


def _parse(call: Call, source: SourceText, span: Span | None = None) -> Value:
    """Read a YAML text.

    Args:
        call: The call that asks for it.
        source: The text.
        span: The origin of all strings, when `source` is no file.
    """
    import yaml

    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    if len(source.text) > MAX_FILE_LENGTH:
        raise call.refuse(f"but {source.file} is longer than {MAX_FILE_LENGTH} characters")
    call.run.budget.spend_parsing(len(source.text))
    try:
        _check(call, source, yaml.parse(source.text, Loader=loader))
        node = yaml.compose(source.text, Loader=loader)
        if node is None:
            return call.run.value(False)
        return _value(call, node, source, span, yaml.SafeLoader(""))
    except (yaml.YAMLError, ValueError, OverflowError) as error:
        where = getattr(error, "problem_mark", None)
        line = f" in line {where.line + 1}" if where else ""
        raise call.refuse(f"but {source.file} is no YAML that can be read{line}") from None


def _check(call: Call, source: SourceText, events: Any) -> None:
    """Refuse aliases (as Ruby does) and deep nesting before anything is built."""
    import yaml

    depth = 0
    for event in events:
        if isinstance(event, yaml.AliasEvent):
            raise call.refuse(f"but {source.file} uses an alias (*{event.anchor})")
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1
        if depth > _MAX_NESTING:
            raise call.refuse(f"but {source.file} is nested too deeply")


def _value(
    call: Call, node: yaml.Node, source: SourceText, span: Span | None, maker: yaml.SafeLoader
) -> Value:
    call.run.budget.spend()
    import yaml

    if isinstance(node, yaml.SequenceNode):
        items = [_value(call, item, source, span, maker) for item in node.value]
        return Value(RubyArray(items), call.run.influences)
    if isinstance(node, yaml.MappingNode):
        result = RubyHash()
        for key_node, value_node in node.value:
            key = _value(call, key_node, source, span, maker)
            result.entries[key_of(key, call.run.budget)] = (
                key,
                _value(call, value_node, source, span, maker),
            )
        return Value(result, call.run.influences)
    if len(node.value) > MAX_NUMBER_LENGTH and not node.tag.endswith(":str"):
        raise call.refuse(f"but {source.file} holds a number that is too long")
    data = maker.construct_object(node)
    if isinstance(data, str):
        here = span or Span(source, node.start_mark.index, node.end_mark.index)
        pieces = (Piece(data, here, False, call.run.influences),) if data else ()
        return Value(RubyString(TracedString(pieces)), call.run.influences)
    if isinstance(data, int) and data.bit_length() > MAX_INTEGER_BITS:
        raise call.refuse(f"but {source.file} holds an integer that is too large")
    if data is not None and not isinstance(data, (bool, int, float)):
        raise call.refuse(f"but {source.file} holds a value of the type {node.tag}")
    return Value(data, call.run.influences)


YAML_FILE: Methods = {
    "load_file": _load_file,
    "safe_load_file": _load_file,
    "load": _load,
    "safe_load": _load,
}
