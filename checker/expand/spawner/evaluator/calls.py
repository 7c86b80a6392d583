"""Calls: arguments, the spawner's own functions, and blocks."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

from checker.expand.spawner.evaluator.assignment import special_identifier, variable
from checker.expand.spawner.evaluator.binding import bind
from checker.expand.spawner.evaluator.expressions import (
    elements,
    hash_of,
    string_content,
)
from checker.expand.spawner.evaluator.interpreter import Handler, Interpreter
from checker.expand.spawner.evaluator.kernel import KERNEL
from checker.expand.spawner.files import absolute
from checker.expand.spawner.limits import MAX_CALLS
from checker.expand.spawner.methods.call import Call, check_arity, invoke_block
from checker.expand.spawner.methods.table import invoke_method
from checker.expand.spawner.scope import Function, Scope
from checker.expand.spawner.signals import Broken, Returned, Unreadable
from checker.expand.spawner.values import NIL, Block, Value
from checker.source.ruby import RubyNode
from checker.source.text import Span

_HASH_PARTS = frozenset({"pair", "hash_splat_argument"})


def _call(run: Interpreter, node: RubyNode) -> Value:
    name = node.fields.get("method")
    if name is None or name.type not in {"identifier", "constant"}:
        raise Unreadable(node.span, f"uses '{node.text[:60]}', which is not read")
    receiver_node = node.fields.get("receiver")
    receiver = run.evaluate(receiver_node) if receiver_node else None
    sign = node.fields.get("operator")
    if receiver is not None and receiver.data is None and sign is not None and sign.text == "&.":
        return receiver
    call = Call(run, node, name.text, receiver or NIL)
    _read_arguments(call, node)
    return _with_break(call, has_receiver=receiver is not None)


def _with_break(call: Call, *, has_receiver: bool) -> Value:
    try:
        return invoke_method(call) if has_receiver else call_bare(call)
    except Broken as jump:
        if call.block is None or jump.block is not call.block:
            raise
        return jump.value


def _read_arguments(call: Call, node: RubyNode) -> None:
    run, arguments = call.run, node.fields.get("arguments")
    parts = arguments.parts if arguments else []
    if arguments is not None and arguments.broken:
        raise Unreadable(node.span, "holds Ruby that the parser does not understand")
    plain = [part for part in parts if part.type not in _HASH_PARTS | {"block_argument"}]
    call.arguments = elements(run, plain)
    pairs = [part for part in parts if part.type in _HASH_PARTS]
    if pairs:
        call.keywords = hash_of(run, pairs)
    block = node.fields.get("block")
    if block is not None:
        call.block = Block(block, run.scope)
    for part in parts:
        if part.type == "block_argument":
            call.block = _block_argument(part)


def _block_argument(node: RubyNode) -> Block:
    if node.parts and node.parts[0].type == "simple_symbol":
        return Block(node, None, node.parts[0].text[1:])
    raise Unreadable(node.span, f"passes {node.text[:40]} as a block")


def _identifier(run: Interpreter, node: RubyNode) -> Value:
    value = variable(run, node)
    if value is None:
        value = special_identifier(run, node)
    if value is not None:
        return value
    return call_bare(Call(run, node, node.text, NIL))


def call_bare(call: Call) -> Value:
    """Call a function without receiver: the spawner's own, or one of Ruby's.

    Raises:
        Unreadable: There is no such function in the subset.
    """
    function = call.run.functions.get(call.name)
    if function is not None:
        return call_function(call, function)
    known = KERNEL.get(call.name)
    if known is None:
        raise Unreadable(call.span, f"calls {call.name}, which is not read")
    check_arity(call, known)
    return known(call, *call.arguments)


def call_function(call: Call, function: Function, *, entry: bool = False) -> Value:
    """Call a function of the spawner.

    Args:
        call: The arguments.
        function: Its definition.
        entry: Note the parameters' names on their values.
    """
    run, node = call.run, function.node
    if node.broken:
        raise Unreadable(function.span, "holds Ruby that the parser does not understand")
    if run.calls >= MAX_CALLS:
        raise Unreadable(call.span, f"calls functions more than {MAX_CALLS} deep")
    scope = Scope(function.path, node, block=call.block)
    before = run.influences
    run.calls += 1
    try:
        with run.inside(scope):
            bind(call, function, scope)
            if entry:
                _name_parameters(scope)
            body = node.fields.get("body")
            return run.evaluate(body) if body else NIL
    except Returned as jump:
        if jump.frame is not scope:
            raise
        return jump.value
    finally:
        run.influences = before
        run.calls -= 1


def _name_parameters(scope: Scope) -> None:
    for name, value in scope.variables.items():
        scope.variables[name] = Value(value.data, value.parameters | {name})


def _yield(run: Interpreter, node: RubyNode) -> Value:
    block = run.scope.call.block
    if block is None:
        raise Unreadable(node.span, "yields without a block")
    arguments = elements(run, [value for part in node.parts for value in part.parts])
    return invoke_block(Call(run, node, "yield", NIL, block=block), arguments)


_FIND = re.compile(r"\s*(?:rospack find ([\w-]+)|echo \$\(rospack find ([\w-]+)\)(/[\w./-]*)?)\s*")


def _subshell(run: Interpreter, node: RubyNode) -> Value:
    """Answer `rospack find PACKAGE` from the workspace; no other command is known."""
    command = string_content(run, node).text
    found = _FIND.fullmatch(command)
    if found is None:
        raise Unreadable(node.span, f"runs the command '{command.strip()[:60]}'")
    package = found.group(1) or found.group(2)
    folder = run.files.package_folder(package)
    if folder is None:
        raise Unreadable(node.span, f"package {package} is not at hand")
    return run.computed(absolute(folder) + (found.group(3) or "") + "\n", node.span)


def entry_call(run: Interpreter, function: Function, arguments: list[Value], span: Span) -> Value:
    """Call `spawner` or another function from outside."""
    call = Call(run, function.node, function.name, NIL, arguments, at=span)
    return call_function(call, function, entry=True)


CALLS: Mapping[str, Handler] = MappingProxyType(
    {"call": _call, "identifier": _identifier, "yield": _yield, "subshell": _subshell}
)
