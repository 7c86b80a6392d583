"""Literals, variables and operators."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from checker.expand.spawner.evaluator.interpreter import Handler, Interpreter
from checker.expand.spawner.heredoc import heredoc_body
from checker.expand.spawner.limits import MAX_INTEGER_BITS
from checker.expand.spawner.literals import (
    Range,
    decode_double,
    decode_raw,
    decode_single,
)
from checker.expand.spawner.signals import Unreadable
from checker.expand.spawner.traced import TracedString
from checker.expand.spawner.values import (
    RubyArray,
    RubyHash,
    RubyRange,
    RubyString,
    Symbol,
    Value,
    key_of,
)
from checker.source.ruby import RubyNode


def _integer(run: Interpreter, node: RubyNode) -> Value:
    digits = node.text.replace("_", "").lower()
    if len(digits) > MAX_INTEGER_BITS // 4:
        raise Unreadable(node.span, "uses an integer that is too large")
    octal = digits[:1] == "0" and digits[1:].isdigit()
    try:
        number = int(digits.removeprefix("0d"), 8 if octal else 10 if digits.isdigit() else 0)
    except ValueError:
        raise Unreadable(node.span, f"uses the number {digits}, which is not read") from None
    return run.value(number)


def _float(run: Interpreter, node: RubyNode) -> Value:
    return run.value(float(node.text.replace("_", "")))


def _string(run: Interpreter, node: RubyNode) -> Value:
    return run.string(string_content(run, node), frozen=_frozen_literals(run, node))


def _frozen_literals(run: Interpreter, node: RubyNode) -> bool:
    """Whether the file's magic comment freezes literals; interpolated ones stay free."""
    tree = run.trees.get(run.scope.path)
    if tree is None or any(part.type == "interpolation" for part in node.children):
        return False
    text = node.source.text
    head = text[: min(text.find("\n", tree.start) + 1, 2000)]
    return "frozen_string_literal: true" in head or "frozen-string-literal: true" in head


def string_content(run: Interpreter, node: RubyNode) -> TracedString:
    """Read a quoted literal of any kind."""
    quotes = node.children
    if len(quotes) < 2 or quotes[0].named or quotes[-1].named:
        raise Unreadable(node.span, "holds a string that is not read")
    opening, closing = quotes[0].text, quotes[-1].text
    start, end = quotes[0].end, quotes[-1].start
    if opening.startswith(("'", "%q", ":'")):
        delimiters = opening[-1] + closing
        return decode_single(node.source, [(start, end)], run.influences, delimiters)
    return _interpolated(run, node, start, end)


def _interpolated(run: Interpreter, node: RubyNode, start: int, end: int) -> TracedString:
    """Read a literal in which escapes and `#{}` count."""
    parts: list[list[Range] | RubyNode] = []
    for hole in node.children:
        if hole.type == "interpolation":
            parts += [[(start, hole.start)], hole]
            start = hole.end
    parts.append([(start, end)])
    return _assembled(run, node, parts, raw=False)


def _assembled(
    run: Interpreter, node: RubyNode, parts: list[list[Range] | RubyNode], *, raw: bool
) -> TracedString:
    decode = decode_raw if raw else decode_double
    lines = [part for part in parts if not isinstance(part, RubyNode)]
    run.budget.spend(sum(map(len, lines)))
    return run.joined(
        *(
            _interpolation(run, part)
            if isinstance(part, RubyNode)
            else decode(node.source, part, run.influences)
            for part in parts
        )
    )


def _interpolation(run: Interpreter, node: RubyNode) -> TracedString:
    if node.broken or any(not part.named and part.text not in "#{}" for part in node.children):
        raise Unreadable(node.span, "holds Ruby that the parser does not understand")
    value = run.run(node.parts)
    run.budget.spend()
    return run.written(value, node.span).computed_by(node.span)


def _heredoc(run: Interpreter, node: RubyNode) -> Value:
    body = heredoc_body(node)
    if body is None or "`" in node.text:
        raise Unreadable(node.span, "holds a heredoc that is not read")
    content = _assembled(run, node, list(body.parts), raw=body.raw)
    has_holes = any(isinstance(part, RubyNode) for part in body.parts)
    return run.string(content, frozen=not has_holes and _frozen_literals(run, node))


def _chained(run: Interpreter, node: RubyNode) -> Value:
    return run.string(run.joined(*(string_content(run, part) for part in node.parts)))


def _character(run: Interpreter, node: RubyNode) -> Value:
    return run.string(decode_double(node.source, [(node.start + 1, node.end)], run.influences))


def _words(run: Interpreter, node: RubyNode) -> Value:
    if node.children[0].text.startswith(("%W", "%I")):
        raise Unreadable(node.span, "uses %W, which is not read")
    quotes = node.children[0].text[-1] + node.children[-1].text + " "
    words = [
        decode_single(part.source, [(part.start, part.end)], run.influences, quotes)
        for part in node.parts
    ]
    if node.type == "symbol_array":
        return run.array([run.value(Symbol(word.text)) for word in words])
    return run.array([run.string(word) for word in words])


def _symbol(run: Interpreter, node: RubyNode) -> Value:
    if node.type == "delimited_symbol":
        return run.value(Symbol(string_content(run, node).text))
    return run.value(Symbol(node.text.lstrip(":")))


def _array(run: Interpreter, node: RubyNode) -> Value:
    if node.parts and all(part.type == "pair" for part in node.parts):
        return run.array([_hash(run, node)])
    return run.array(elements(run, node.parts))


def elements(run: Interpreter, nodes: list[RubyNode]) -> list[Value]:
    """Evaluate elements of a list, taking `*array` apart."""
    items: list[Value] = []
    for node in nodes:
        if node.type != "splat_argument":
            items.append(run.evaluate(node))
            continue
        value = run.run(node.parts)
        run.budget.spend_items(len(items))
        if isinstance(value.data, RubyRange):
            run.budget.spend(value.data.count)
            items += [run.value(number, value) for number in value.data.numbers]
        elif isinstance(value.data, RubyArray):
            run.budget.spend_items(len(value.data.items))
            items += value.data.items
        else:
            raise Unreadable(node.span, "takes apart something that is no array")
    return items


def _hash(run: Interpreter, node: RubyNode) -> Value:
    return hash_of(run, node.parts)


def hash_of(run: Interpreter, nodes: list[RubyNode]) -> Value:
    """Make a hash of `key => value`, `key: value` and `**hash`."""
    result = RubyHash()
    for node in nodes:
        if node.type == "hash_splat_argument" and node.parts:
            other = run.evaluate(node.parts[0])
            if not isinstance(other.data, RubyHash):
                raise Unreadable(node.span, "takes apart something that is no hash")
            run.budget.spend_items(len(other.data.entries))
            result.entries.update(other.data.entries)
            continue
        value_node = node.fields.get("value")
        if node.type != "pair" or value_node is None:
            raise Unreadable(node.span, "holds a hash entry that is not read")
        key = _pair_key(run, node)
        store(run, result, key, run.evaluate(value_node), node)
    return Value(result, run.influences)


def _pair_key(run: Interpreter, pair: RubyNode) -> Value:
    key = pair.fields["key"]
    if key.type == "hash_key_symbol":
        return _symbol(run, key)
    symbol = any(not part.named and part.text == ":" for part in pair.children)
    if symbol and key.type == "string":
        return run.value(Symbol(string_content(run, key).text))
    return run.evaluate(key)


def store(run: Interpreter, target: RubyHash, key: Value, value: Value, node: RubyNode) -> None:
    """Set an entry; a string key is copied, as Ruby does."""
    try:
        identity = key_of(key, run.budget)
    except ValueError as error:
        raise Unreadable(node.span, f"uses {error} as the key of a hash") from None
    if isinstance(key.data, RubyString):
        key = Value(RubyString(key.data.content, frozen=True), key.parameters)
    previous = target.entries.get(identity)
    target.entries[identity] = (previous[0] if previous else key, value)


def _range(run: Interpreter, node: RubyNode) -> Value:
    ends = [node.fields.get("begin"), node.fields.get("end")]
    values = [run.evaluate(end) for end in ends if end is not None]
    numbers = [value.data for value in values]
    if len(numbers) == 2:
        first, last = numbers
        if type(first) is int and type(last) is int:
            exclusive = node.fields["operator"].text == "..."
            return run.value(RubyRange(first, last, exclusive), *values)
    raise Unreadable(node.span, "uses a range of something else than integers")


EXPRESSIONS: Mapping[str, Handler] = MappingProxyType(
    {
        "integer": _integer,
        "float": _float,
        "string": _string,
        "chained_string": _chained,
        "heredoc_beginning": _heredoc,
        "character": _character,
        "string_array": _words,
        "symbol_array": _words,
        "simple_symbol": _symbol,
        "delimited_symbol": _symbol,
        "array": _array,
        "hash": _hash,
        "range": _range,
        "true": lambda run, _node: run.value(True),
        "false": lambda run, _node: run.value(False),
        "nil": lambda run, _node: run.value(None),
    }
)
