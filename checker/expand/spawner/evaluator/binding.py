"""Arguments to parameters."""

from __future__ import annotations

from checker.expand.spawner.methods.call import Call
from checker.expand.spawner.scope import Function, Parameter, Scope
from checker.expand.spawner.signals import RubyError, Unreadable
from checker.expand.spawner.values import NIL, RubyHash, RubyString, Symbol, Value

_KNOWN = frozenset({"required", "optional", "rest", "keyword", "required_keyword", "keyword_rest"})


def bind(call: Call, function: Function, scope: Scope) -> None:
    """Set the parameters of a function in its scope; defaults may use earlier ones.

    Raises:
        RubyError: Ruby refuses the number or the names of the arguments.
        Unreadable: A kind of parameter that is not read.
    """
    call.run.budget.spend_items(len(function.parameters))
    for parameter in function.parameters:
        if parameter.kind not in _KNOWN:
            raise Unreadable(parameter.span, f"has the parameter {parameter.span.text[:40]}")
    takes_keywords = any("keyword" in parameter.kind for parameter in function.parameters)
    positional = list(call.arguments)
    if call.keywords is not None and not takes_keywords:
        positional.append(call.keywords)
    _bind_positional(call, function, scope, positional)
    if takes_keywords:
        _bind_keywords(call, function, scope)


def _bind_positional(call: Call, function: Function, scope: Scope, arguments: list[Value]) -> None:
    listed = [p for p in function.parameters if "keyword" not in p.kind]
    optional = sum(p.kind == "optional" for p in listed)
    endless = any(p.kind == "rest" for p in listed)
    required = function.required
    if len(arguments) < required or (len(arguments) > required + optional and not endless):
        most = "+" if endless else f"..{required + optional}" if optional else ""
        raise RubyError(
            "ArgumentError",
            f"wrong number of arguments (given {len(arguments)}, expected {required}{most})",
            call.span,
        )
    given = min(optional, len(arguments) - required)
    surplus = len(arguments) - required - given
    at = 0
    for parameter in listed:
        if parameter.kind == "rest":
            scope.variables[parameter.name] = call.run.array(arguments[at : at + surplus])
            at += surplus
        elif parameter.kind == "optional" and given == 0:
            scope.variables[parameter.name] = _default(call, parameter)
        else:
            given -= parameter.kind == "optional"
            scope.variables[parameter.name] = arguments[at]
            at += 1


def _bind_keywords(call: Call, function: Function, scope: Scope) -> None:
    given = _keywords(call)
    for parameter in function.parameters:
        if parameter.kind == "keyword_rest":
            rest = RubyHash({key: entry for key, entry in given.items() if entry is not None})
            scope.variables[parameter.name] = call.run.value(rest)
            return
        if "keyword" not in parameter.kind:
            continue
        entry = given.pop(("Symbol", Symbol(parameter.name)), None)
        if entry is not None:
            scope.variables[parameter.name] = entry[1]
        elif parameter.kind == "keyword":
            scope.variables[parameter.name] = _default(call, parameter)
        else:
            message = f"missing keyword: :{parameter.name}"
            raise RubyError("ArgumentError", message, call.span)
    if given:
        raise RubyError("ArgumentError", "unknown keyword", call.span)


def _keywords(call: Call) -> dict[object, tuple[Value, Value]]:
    data = call.keywords.data if call.keywords else None
    entries = data.entries if isinstance(data, RubyHash) else {}
    call.run.budget.spend_items(len(entries))
    if any(isinstance(key.data, RubyString) for key, _ in entries.values()):
        raise Unreadable(call.span, "passes a string as the name of an argument")
    return dict(entries)


def _default(call: Call, parameter: Parameter) -> Value:
    return call.run.evaluate(parameter.default) if parameter.default else NIL
