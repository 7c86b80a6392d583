"""Literals: numbers, texts, symbols, arrays, hashes and ranges."""

from __future__ import annotations

import re
from collections.abc import Mapping

from checker.launch.spawner.evaluator.interpreter import Handler, Interpreter
from checker.launch.spawner.limits import MAX_INTEGER_BITS
from checker.launch.spawner.literals import (
    DOUBLE_QUOTED,
    RAW,
    Range,
    TracedString,
    decode_literal,
    heredoc_parts,
    single_quoted,
)
from checker.launch.spawner.signals import Unreadable
from checker.launch.spawner.values import (
    RubyArray,
    RubyHash,
    RubyRange,
    RubyString,
    Symbol,
    Value,
    key_of,
)
from checker.source.ruby import RubyNode


def _integer(_run: Interpreter, node: RubyNode) -> Value:
    digits = node.text.replace("_", "")
    if len(digits) > MAX_INTEGER_BITS // 4:
        raise Unreadable(node.span, "uses an integer that is too large")
    if not digits.isdigit() or (digits[0] == "0" and digits != "0"):
        raise Unreadable(node.span, f"uses the number {digits}, which is not decimal")
    return int(digits)


def _float(_run: Interpreter, node: RubyNode) -> Value:
    return float(node.text.replace("_", ""))


def _string(run: Interpreter, node: RubyNode) -> Value:
    return run.string(string_content(run, node), frozen=_frozen_literals(run, node))


def _frozen_literals(run: Interpreter, node: RubyNode) -> bool:
    """Return whether the file's magic comment freezes literals; interpolated ones stay mutable."""
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
        raise Unreadable(node.span, "contains a string that is not supported")
    opening, closing = quotes[0].text, quotes[-1].text
    start, end = quotes[0].end, quotes[-1].start
    if opening.startswith(("'", "%q")):
        escapes = single_quoted(opening[-1] + closing)
        return decode_literal(node.source, [(start, end)], escapes)
    parts: list[list[Range] | RubyNode] = []
    for hole in node.children:
        if hole.type == "interpolation":
            parts += [[(start, hole.start)], hole]
            start = hole.end
    return _assembled(run, node, [*parts, [(start, end)]], DOUBLE_QUOTED)


def _assembled(
    run: Interpreter,
    node: RubyNode,
    parts: list[list[Range] | RubyNode],
    escapes: re.Pattern[str],
) -> TracedString:
    run.budget.spend(sum(len(part) for part in parts if not isinstance(part, RubyNode)))
    return run.joined(
        *(
            _interpolation(run, part)
            if isinstance(part, RubyNode)
            else decode_literal(node.source, part, escapes)
            for part in parts
        )
    )


def _interpolation(run: Interpreter, node: RubyNode) -> TracedString:
    if node.broken or any(not part.named and part.text not in "#{}" for part in node.children):
        raise Unreadable(node.span, "contains Ruby that the parser does not understand")
    value = run.run(node.parts)
    run.budget.spend()
    return run.written(value, node.span).computed_by(node.span)


def _heredoc(run: Interpreter, node: RubyNode) -> Value:
    parts = heredoc_parts(node)
    if parts is None or "`" in node.text:
        raise Unreadable(node.span, "contains a heredoc that is not supported")
    content = _assembled(run, node, parts, RAW if "'" in node.text else DOUBLE_QUOTED)
    return run.string(content, frozen=len(parts) == 1 and _frozen_literals(run, node))


def _chained(run: Interpreter, node: RubyNode) -> Value:
    return run.string(run.joined(*(string_content(run, part) for part in node.parts)))


def _words(run: Interpreter, node: RubyNode) -> Value:
    if node.children[0].text.startswith("%W"):
        raise Unreadable(node.span, "uses %W, which is not supported")
    escapes = single_quoted(node.children[0].text[-1] + node.children[-1].text + " ")
    words = [decode_literal(part.source, [(part.start, part.end)], escapes) for part in node.parts]
    return run.array([run.string(word) for word in words])


def _symbol(_run: Interpreter, node: RubyNode) -> Value:
    return Symbol(node.text.lstrip(":"))


def _array(run: Interpreter, node: RubyNode) -> Value:
    return run.array(elements(run, node.parts))


def elements(run: Interpreter, nodes: list[RubyNode]) -> list[Value]:
    """Evaluate elements of a list, taking `*array` apart."""
    items: list[Value] = []
    for node in nodes:
        if node.type != "splat_argument":
            items.append(run.evaluate(node))
            continue
        value = run.run(node.parts)
        if not isinstance(value, RubyArray):
            raise Unreadable(node.span, "unpacks a value that is not an array")
        run.budget.spend_items(len(items) + len(value.items))
        items += value.items
    return items


def _hash(run: Interpreter, node: RubyNode) -> Value:
    result = RubyHash()
    for pair in node.parts:
        value = pair.fields.get("value")
        if pair.type != "pair" or value is None:
            raise Unreadable(pair.span, "contains a hash entry that is not supported")
        store(run, result, _pair_key(run, pair), run.evaluate(value), pair)
    return result


def _pair_key(run: Interpreter, pair: RubyNode) -> Value:
    key = pair.fields["key"]
    if key.type == "hash_key_symbol":
        return _symbol(run, key)
    if key.type == "string" and any(part.type == ":" for part in pair.children):
        return Symbol(string_content(run, key).text)
    return run.evaluate(key)


def store(run: Interpreter, target: RubyHash, key: Value, value: Value, node: RubyNode) -> None:
    """Set an entry; a string key is copied, as Ruby does."""
    try:
        identity = key_of(key, run.budget)
    except ValueError as error:
        raise Unreadable(node.span, f"uses {error} as the key of a hash") from None
    if isinstance(key, RubyString):
        key = RubyString(key.content, frozen=True)
    previous = target.entries.get(identity)
    target.entries[identity] = (previous[0] if previous else key, value)


def _range(run: Interpreter, node: RubyNode) -> Value:
    ends = [node.fields.get("begin"), node.fields.get("end")]
    values = [run.evaluate(end) for end in ends if end is not None]
    if len(values) == 2:
        first, last = values
        if type(first) is int and type(last) is int:
            exclusive = node.fields["operator"].text == "..."
            return RubyRange(first, last, exclusive)
    raise Unreadable(node.span, "uses a range that is not of integers")


EXPRESSIONS: Mapping[str, Handler] = {
    "integer": _integer,
    "float": _float,
    "string": _string,
    "chained_string": _chained,
    "heredoc_beginning": _heredoc,
    "string_array": _words,
    "simple_symbol": _symbol,
    "array": _array,
    "hash": _hash,
    "range": _range,
    "true": lambda _run, _node: True,
    "false": lambda _run, _node: False,
    "nil": lambda _run, _node: None,
}
