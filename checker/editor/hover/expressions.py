"""Hover text of macros, properties and arguments of xacro, and of the value of an expression."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator

from checker.base.record import Record
from checker.base.resources import table
from checker.editor.card import card, code, escaped_words, names
from checker.editor.hover.pointed import Pointed
from checker.editor.robot_parts import RobotParts
from checker.editor.xacro_names import PREFIX, TAGS, Macro, XacroNames, macro_around
from checker.editor.xml_context import Where
from checker.formats.xacro.files import ROOT, local_path, path_of
from checker.package.package import Package
from checker.source.text import Span
from checker.source.xml import Element, XmlDocument

_TOKEN = re.compile(r"\$\{[^}]{0,1000}\}|\$\([^)]{0,1000}\)")
_LENGTH = 1010
"""Characters that an expression may have."""
_NAME = re.compile(r"[A-Za-z_]\w*")
_FIND = re.compile(r"\$\(find\s{1,8}([\w.-]{1,200})\s{0,8}\)")
_COMMAND = re.compile(r"\$\((arg|find)\s+([\w.-]+)\s*\)")


class Expression(Record):
    """A `${…}` or `$(…)` under the pointer, with its place in the file.

    Attributes:
        text: The text with its brackets.
        word: The name in it that the pointer is on; empty for none.
    """

    text: str
    word: str
    start: int
    end: int


def expression_at(pointed: Pointed, offset: int) -> Expression | None:
    """Return the expression of xacro at an offset; None if there is none."""
    if pointed.where not in (Where.VALUE, Where.TEXT):
        return None
    span = pointed.span
    start, end = max(span.start, offset - _LENGTH), min(span.end, offset + _LENGTH)
    for match in _TOKEN.finditer(span.source.text, start, end):
        if match.start() <= offset <= match.end():
            found = _NAME.finditer(span.source.text, match.start(), match.end())
            word = next((it[0] for it in found if it.start() <= offset <= it.end()), "")
            return Expression(match[0], word, match.start(), match.end())
    return None


def expression_card(
    expression: Expression, pointed: Pointed, names_: XacroNames, parts: RobotParts
) -> str | None:
    """Return the names and value of an expression, as Markdown; None if unknown."""
    command = _COMMAND.fullmatch(expression.text)
    rows = []
    if command is not None and command[1] == "find":
        rows.append(("package", code(command[2])))
    elif command is not None:
        rows += [*_argument(command[2], names_)]
    else:
        rows += [*_named_in(expression, pointed.element, names_)]
    rows.append(("comes to", _expanded(pointed, parts)))
    known = card(f"**xacro** {code(expression.text)}", rows)
    return known if any(text for _, text in rows) else None


def _argument(name: str, known: XacroNames) -> Iterator[tuple[str, str]]:
    argument = known.arguments.get(name)
    if argument is None:
        yield "argument", f"{code(name)} is declared nowhere"
        return
    default = "required" if argument.default is None else f"default {code(argument.default)}"
    yield f"argument {code(name)}", f"{default}, in {_place(argument.element)}"


def _named_in(
    expression: Expression, element: Element, known: XacroNames
) -> Iterator[tuple[str, str]]:
    """Yield what the name under the pointer represents; without one, what all names do."""
    inner = [expression.word] if expression.word else _NAME.findall(expression.text)
    macro = macro_around(element)
    parameters = {} if macro is None else {it.name: it for it in macro.parameters}
    for name in dict.fromkeys(inner):
        if (parameter := parameters.get(name)) is not None and macro is not None:
            yield (
                f"parameter {code(name)}",
                f"of {code(macro.name)}, {escaped_words(parameter.requirement)}",
            )
        elif (found := known.properties.get(name)) is not None:
            value = code(found.value) if found.value else "elements"
            yield f"property {code(name)}", f"{value}, in {_place(found.element)}"


def _expanded(pointed: Pointed, parts: RobotParts) -> str:
    """Return what xacro makes of the whole attribute or text."""
    values: dict[str, None] = {}
    for copy in parts.copies_of(pointed.element):
        is_text = pointed.where is Where.TEXT
        value = copy.value if is_text else copy.attributes.get(pointed.attribute, "")
        if value and value != pointed.value:
            values[value] = None
    return names(list(values))


def tag_card(element: Element, known: XacroNames) -> str | None:
    """Return what is known of an element of xacro's own: a macro, its call, a property."""
    name = element.tag.removeprefix(PREFIX)
    stated = element.get("name") or ""
    if name not in TAGS:
        macro = known.macros.get(name)
        return None if macro is None else macro_card(macro)
    if name == "macro" and (macro := known.macros.get(stated)) is not None:
        return macro_card(macro)
    if name == "call" and (macro := known.macros.get(element.get("macro") or "")) is not None:
        return macro_card(macro)
    _, meaning = table("xml_meanings")["xacro"][name]
    rows = []
    if name == "property" and (found := known.properties.get(stated)) is not None:
        rows.append(("value", code(found.value) if found.value else "elements"))
    return card(f"{code(f'<{element.tag}>')}: {meaning}", rows)


def include_card(package: Package, element: Element) -> str | None:
    """Return the file that a `<xacro:include>` names, as Markdown; None if it is computed."""
    name = _FIND.sub(lambda match: f"{ROOT}/{match[1]}", element.get("filename") or "")
    if "$" in name or not name:
        return None
    folder = posixpath.dirname(path_of(package, element.source.file))
    path = local_path(package, posixpath.join(folder, name))
    title = f"**file** {code(path or name)}"
    if path is None or not package.exists(path):
        return card(title, [], "It is not available.")
    macros = [macro.name for macro in XacroNames(_documents(package, path)).macros.values()]
    return card(title, [("macros", names(macros))])


def _documents(package: Package, path: str) -> tuple[XmlDocument, ...]:
    document = package.xml(path)
    return (document,) if isinstance(document, XmlDocument) else ()


def macro_card(macro: Macro) -> str:
    """Return the parameters of a macro and where it is defined, as Markdown."""
    rows = [
        (code(f"{it.block}{it.name}"), escaped_words(it.requirement)) for it in macro.parameters
    ]
    makes = [it.tag for it in macro.element.children if not it.tag.startswith(PREFIX)]
    rows.append(("makes", names(list(dict.fromkeys(makes)))))
    return card(f"**macro** {code(macro.name)} of {_place(macro.element)}", rows)


def _place(element: Element) -> str:
    span: Span = element.span
    return escaped_words(f"{span.source.file}:{span.line}")
