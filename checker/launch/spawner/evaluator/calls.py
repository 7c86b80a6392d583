"""Calls: arguments, blocks, and the spawner's own functions with their parameters."""

from __future__ import annotations

import re
from collections.abc import Mapping

from checker.launch.spawner.evaluator.expressions import elements, string_content
from checker.launch.spawner.evaluator.interpreter import Handler, Interpreter
from checker.launch.spawner.files import absolute, folder_of
from checker.launch.spawner.limits import MAX_CALLS
from checker.launch.spawner.methods.call import Call, check_arity
from checker.launch.spawner.methods.classes import KERNEL, invoke_method
from checker.launch.spawner.scope import Function, Parameter, Scope
from checker.launch.spawner.signals import Broken, Returned, RubyError, Unreadable
from checker.launch.spawner.values import Block, Value
from checker.source.ruby import RubyNode

_FIND = re.compile(r"\s*rospack find ([\w-]+)\s*")


def _call(run: Interpreter, node: RubyNode) -> Value:
    name = node.fields.get("method")
    if name is None or name.type not in {"identifier", "constant"}:
        raise Unreadable(node.span, f"uses '{node.text[:60]}', which is not supported")
    receiver_node = node.fields.get("receiver")
    receiver = run.evaluate(receiver_node) if receiver_node else None
    sign = node.fields.get("operator")
    if receiver_node and receiver is None and sign is not None and sign.text == "&.":
        return None
    call = Call(run, node, name.text, receiver)
    _read_arguments(call, node)
    try:
        return invoke_method(call) if receiver_node else _call_bare(call)
    except Broken as jump:
        if call.block is None or jump.block is not call.block:
            raise
        return jump.value


def _read_arguments(call: Call, node: RubyNode) -> None:
    arguments, block = node.fields.get("arguments"), node.fields.get("block")
    if arguments is not None and arguments.broken:
        raise Unreadable(node.span, "contains Ruby that the parser does not understand")
    if block is not None:
        call.block = Block(block, call.run.scope)
    plain = []
    for part in arguments.parts if arguments else []:
        if part.type == "pair":
            name, value = _named(call.run, part)
            call.named[name] = value
        elif part.type == "block_argument":
            call.block = _block_argument(part)
        else:
            plain.append(part)
    call.arguments = elements(call.run, plain)


def _named(run: Interpreter, pair: RubyNode) -> tuple[str, Value]:
    key, value = pair.fields["key"], pair.fields.get("value")
    if key.type != "hash_key_symbol" or value is None:
        raise Unreadable(pair.span, f"passes {pair.text[:40]}, which is not supported")
    return key.text, run.evaluate(value)


def _block_argument(node: RubyNode) -> Block:
    if node.parts and node.parts[0].type == "simple_symbol":
        return Block(node, None, node.parts[0].text[1:])
    raise Unreadable(node.span, f"passes {node.text[:40]} as a block")


def _identifier(run: Interpreter, node: RubyNode) -> Value:
    holder = run.scope.holder(node.text)
    if holder is not None:
        return holder.variables[node.text]
    if node.text == "__FILE__":
        return run.computed(absolute(run.scope.path), node.span)
    if node.text == "__dir__":
        return run.computed(folder_of(absolute(run.scope.path)), node.span)
    return _call_bare(Call(run, node, node.text, None))


def _call_bare(call: Call) -> Value:
    """Call a function without receiver: the spawner's own, or one of Ruby's."""
    function = call.run.functions.get(call.name)
    if function is not None:
        return call_function(call, function)
    known = KERNEL.get(call.name)
    if known is None:
        raise Unreadable(call.span, f"calls {call.name}, which is not supported")
    check_arity(call, known)
    return known(call, *call.arguments)


def call_function(call: Call, function: Function) -> Value:
    """Call a function of the spawner."""
    run, node = call.run, function.node
    if node.broken:
        raise Unreadable(function.span, "contains Ruby that the parser does not understand")
    if run.calls >= MAX_CALLS:
        raise Unreadable(call.span, f"calls functions more than {MAX_CALLS} deep")
    scope = Scope(function.path)
    run.calls += 1
    try:
        with run.inside(scope):
            _bind(call, function, scope)
            body = node.fields.get("body")
            return run.evaluate(body) if body else None
    except Returned as jump:
        if jump.frame is not scope:
            raise
        return jump.value
    finally:
        run.calls -= 1


def _bind(call: Call, function: Function, scope: Scope) -> None:
    """Set the parameters of a function in its scope; defaults may use earlier ones."""
    call.run.budget.spend_items(len(function.parameters))
    for parameter in function.parameters:
        if parameter.kind == "unknown":
            raise Unreadable(parameter.span, f"has the parameter {parameter.span.text[:40]}")
    _bind_positional(call, function, scope)
    _bind_named(call, function, scope)


def _bind_positional(call: Call, function: Function, scope: Scope) -> None:
    listed = [p for p in function.parameters if "keyword" not in p.kind]
    optional = sum(p.kind == "optional" for p in listed)
    endless = any(p.kind == "rest" for p in listed)
    required, count = function.required, len(call.arguments)
    if count < required or (count > required + optional and not endless):
        most = "+" if endless else f"..{required + optional}" if optional else ""
        message = f"wrong number of arguments (given {count}, expected {required}{most})"
        raise RubyError("ArgumentError", message, call.span)
    filled = min(optional, count - required)
    surplus = count - required - filled
    at = 0
    for parameter in listed:
        if parameter.kind == "rest":
            scope.variables[parameter.name] = call.run.array(call.arguments[at : at + surplus])
            at += surplus
        elif parameter.kind == "optional" and filled == 0:
            scope.variables[parameter.name] = _default(call, parameter)
        else:
            filled -= parameter.kind == "optional"
            scope.variables[parameter.name] = call.arguments[at]
            at += 1


def _bind_named(call: Call, function: Function, scope: Scope) -> None:
    named = dict(call.named)
    keywords = [p for p in function.parameters if "keyword" in p.kind]
    if named and not keywords:
        raise Unreadable(call.span, f"calls {call.name} with named arguments")
    for parameter in keywords:
        if parameter.name in named:
            scope.variables[parameter.name] = named.pop(parameter.name)
        elif parameter.kind == "keyword":
            scope.variables[parameter.name] = _default(call, parameter)
        else:
            raise RubyError("ArgumentError", f"missing keyword: :{parameter.name}", call.span)
    if named:
        raise RubyError("ArgumentError", f"unknown keyword: :{next(iter(named))}", call.span)


def _default(call: Call, parameter: Parameter) -> Value:
    return call.run.evaluate(parameter.default) if parameter.default else None


def _subshell(run: Interpreter, node: RubyNode) -> Value:
    """Answer `rospack find PACKAGE` from the workspace; no other command is known."""
    command = string_content(run, node).text
    match = _FIND.fullmatch(command)
    if match is None:
        raise Unreadable(node.span, f"runs the command '{command.strip()[:60]}'")
    folder = run.files.package_folder(match.group(1))
    if folder is None:
        raise Unreadable(node.span, f"package {match.group(1)} is not available")
    return run.computed(absolute(folder) + "\n", node.span)


CALLS: Mapping[str, Handler] = {"call": _call, "identifier": _identifier, "subshell": _subshell}
