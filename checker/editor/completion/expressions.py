"""Completions of xacro: tags, macros, properties in `${`, arguments and packages in `$(`."""

from __future__ import annotations

import re
from collections.abc import Iterator

from checker.editor.card import code, escaped_words
from checker.editor.completion.item import Completion, CompletionKind, Request
from checker.editor.completion.snippet import Snippet
from checker.editor.xacro_names import PREFIX, Macro
from checker.editor.xml_context import Where
from checker.formats.xacro.names import MacroParameter, parameters_of

_OPEN = re.compile(r"\$(?:\{(?P<expression>[^}]*)|\((?P<command>[^)]*))\Z")
_WORD = re.compile(r"[A-Za-z_]\w*\Z")
_COMMANDS = ("arg", "find", "eval", "env", "optenv", "dirname", "anon")
_CONSTANTS = ("pi", "radians", "degrees", "sin", "cos", "tan", "sqrt", "xacro.load_yaml")
_TYPED_LIMIT = 2000
"""Characters in front of the caret in which the expression may begin."""
_ATTRIBUTES = {
    "macro": ("name", "params"),
    "property": ("name", "value", "default", "scope"),
    "arg": ("name", "default"),
    "if": ("value",),
    "unless": ("value",),
    "include": ("filename", "ns"),
    "insert_block": ("name",),
    "call": ("macro",),
    "element": ("xacro:name",),
    "attribute": ("name", "value"),
}
_INSIDE = ("macro", "if", "unless")


def expressions(request: Request) -> list[Completion] | None:
    """Return what may be in the expression at the caret; None if there is none."""
    if request.xml.where not in (Where.VALUE, Where.TEXT) or not request.is_xacro:
        return None
    match = _OPEN.search(request.xml.typed[-_TYPED_LIMIT:])
    if match is None:
        return None
    if match["command"] is not None:
        return [*_commands(request, match["command"])]
    return [*_values(request, match["expression"])]


def _values(request: Request, written: str) -> Iterator[Completion]:
    start = _start(request, written)
    for parameter in _macro_parameters(request):
        yield _expression_word(
            request, parameter.name, CompletionKind.PARAMETER, parameter.requirement, 0, start
        )
    for name, known in request.names.properties.items():
        yield _expression_word(request, name, CompletionKind.PROPERTY, known.value[:80], 2, start)
    for name in _CONSTANTS:
        yield _expression_word(request, name, CompletionKind.VALUE, "", 6, start)


def _commands(request: Request, written: str) -> Iterator[Completion]:
    command, blank, rest = written.lstrip().partition(" ")
    if not blank:
        start = _start(request, written)
        for name in _COMMANDS:
            yield _expression_word(request, name, CompletionKind.VALUE, "", 2, start)
        return
    start = request.offset - len(rest.lstrip())
    if command == "arg":
        for name, known in request.names.arguments.items():
            detail = "required" if known.default is None else f"default {known.default[:80]}"
            yield _expression_word(request, name, CompletionKind.ARGUMENT, detail, 0, start)
    elif command == "find":
        for name in packages(request):
            yield _expression_word(request, name, CompletionKind.PACKAGE, "", 0, start)


def packages(request: Request) -> list[str]:
    """Return the names of the packages of the workspace, the package's own first."""
    own = request.subject.package
    return list(dict.fromkeys([own.declared_name, *sorted(own.workspace.packages)]))


def _start(request: Request, written: str) -> int:
    match = _WORD.search(written)
    return request.offset - (len(match[0]) if match is not None else 0)


def _expression_word(
    request: Request, name: str, kind: CompletionKind, detail: str, rank: int, start: int
) -> Completion:
    """Return a word of an expression: from its start to the caret only."""
    text = f"{rank}{name}"
    return Completion(name, kind, detail, "", name, start, request.offset, False, text)


def _macro_parameters(request: Request) -> tuple[MacroParameter, ...]:
    """Return the parameters of the macro around the caret, as the text has them now."""
    macros = (it for it in reversed(request.xml.around) if it.tag == f"{PREFIX}macro")
    macro = next(macros, None)
    return () if macro is None else parameters_of(macro.attributes.get("params", ""))


def tags(request: Request) -> Iterator[Completion]:
    """Yield xacro's own tags, and the calls of macros."""
    if not request.is_xacro:
        return
    innermost = request.xml.innermost
    called = innermost.tag.removeprefix(PREFIX) if innermost is not None else ""
    macro = request.names.macros.get(called)
    if macro is not None and any(it.block and "origin" in it.name for it in macro.parameters):
        yield request.element("origin", 'origin xyz="$1" rpy="$2"/>', detail=called, rank=0)
    for name, stated in _ATTRIBUTES.items():
        first = Snippet().attributes([(it, "") for it in stated[:2] if it not in ("ns", "default")])
        inside = f">\n  $0\n</{PREFIX}{name}>" if name in _INSIDE else "/>"
        text = f"{PREFIX}{name}{first}{inside}"
        yield request.element(PREFIX + name, text, detail="xacro", rank=8)
    for macro in request.names.macros.values():
        documentation = "\n".join(
            f"- {code(it.name)}: {escaped_words(it.requirement)}" for it in macro.parameters
        )
        yield request.element(
            PREFIX + macro.name,
            _call(macro),
            kind=CompletionKind.MACRO,
            detail=macro.element.source.file,
            documentation=documentation,
            rank=6,
        )


def _call(macro: Macro) -> str:
    """Return a call that states what the macro has to be given."""
    needed = [it for it in macro.parameters if it.default is None and not it.block]
    start = PREFIX + macro.name + Snippet().attributes([(it.name, "") for it in needed])
    blocks = any(it.block for it in macro.parameters)
    return f"{start}>\n  $0\n</{PREFIX}{macro.name}>" if blocks else f"{start}/>"


def attributes(request: Request) -> Iterator[Completion]:
    """Yield the attributes of a tag of xacro's own, or the parameters of a macro."""
    name = request.xml.tag.removeprefix(PREFIX)
    if name in _ATTRIBUTES:
        for stated in _ATTRIBUTES[name]:
            if stated not in request.xml.attributes:
                yield request.attribute(stated, "", "xacro")
    elif (macro := request.names.macros.get(name)) is not None:
        for it in macro.parameters:
            if not it.block and it.name not in request.xml.attributes:
                rank = 0 if it.default is None else 5
                yield request.attribute(it.name, it.default or "", it.requirement, rank=rank)


def values(request: Request) -> Iterator[Completion]:
    """Yield what an attribute of xacro's own may contain: names of blocks, of macros."""
    here = (request.xml.tag, request.xml.attribute)
    if here == (f"{PREFIX}insert_block", "name"):
        for it in _macro_parameters(request):
            if it.block:
                yield request.item(it.name, CompletionKind.PARAMETER, rank=0)
    elif here == (f"{PREFIX}call", "macro"):
        for name in request.names.macros:
            yield request.item(name, CompletionKind.MACRO, rank=0)
