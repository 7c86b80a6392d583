"""Names that xacro itself knows: macros, properties and arguments; and names given to macros."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterator

from checker.editor.names.mention import ANY_PART, Included, NameKind, Role, WrittenName
from checker.editor.names.readers.expressions import is_composed
from checker.editor.names.readers.plugin_names import verbatim
from checker.editor.names.readers.values import kinds_of, names_in
from checker.editor.xacro_names import PREFIX, TAGS
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument

_DIRECTIVES = frozenset((*TAGS, "robot"))
_OWN_ATTRIBUTES = ("name", "params", "filename")
_EXPRESSION = re.compile(r"\$\{([^{}]{0,2000})\}")
_ARGUMENT = re.compile(r"\$\(arg\s+([A-Za-z_]\w*)\s*\)")
_COMPOSED_ARGUMENT = re.compile(r"\$\(arg\s+((?:[\w.-]|\$\{[^{}()]{0,200}\})*\$[^\s()]*)\s*\)")
_FUNCTION_ARGUMENT = re.compile(r"""xacro\.arg\(\s*['"]([A-Za-z_]\w*)['"]\s*\)""")
_QUOTED = re.compile(r"""'([^']{0,200})'|"([^"]{0,200})\"""")
_IDENTIFIER = re.compile(r"(?<![\w.])[A-Za-z_]\w*")
_PARAMETER = re.compile(
    r"""(?P<block>\*{0,2})(?P<name>[A-Za-z_]\w*)"""
    r"""(?::?=(?P<outer>\^\|?)?(?:'(?P<a>[^']*)'|"(?P<b>[^"]*)"|(?P<c>[^\s'"]+))?)?"""
)
_BLANKS = re.compile(r"\s+")


class XacroNames:
    """The reading of one file.

    Attributes:
        names: What is written, as it is found.
        included: Files that it includes.
        values: Texts that expressions may have as values.
        parameters: Names of all parameters of macros.
    """

    def __init__(self, document: XmlDocument) -> None:
        """Read all of it."""
        self.names: list[WrittenName] = []
        self.included: list[Included] = []
        self.values: set[str] = set()
        self.parameters: set[str] = set()
        waiting: list[tuple[Element, frozenset[str]]] = [(document.root, frozenset())]
        while waiting:
            element, shadowed = waiting.pop()
            inside = self._element(element, shadowed)
            waiting += [(child, inside) for child in element.children]

    def _element(self, element: Element, shadowed: frozenset[str]) -> frozenset[str]:
        """Read one element; return the names that mean parameters in it."""
        tag = element.tag.removeprefix(PREFIX) if element.tag.startswith(PREFIX) else ""
        for name, value in element.attributes.items():
            is_given = tag and not (tag in _DIRECTIVES and name in _OWN_ATTRIBUTES)
            if not is_given and "$" not in value:
                continue
            text = verbatim(element.attribute(name))
            if text is not None:
                if "$" in value:
                    self._expressions(text, shadowed)
                if is_given:
                    self._value(text, name if tag != "property" else element.get("name") or "")
        if not element.children and "$" in element.value and (text := verbatim(element.text)):
            self._expressions(text, shadowed)
        if not tag:
            return shadowed
        if tag == "macro":
            return shadowed | self._macro(element)
        self._directive(element, tag)
        return shadowed

    def _directive(self, element: Element, tag: str) -> None:
        if tag == "property":
            self._name(element, "name", NameKind.PROPERTY, Role.DEFINES)
        elif tag == "arg":
            self._name(element, "name", NameKind.ARGUMENT, Role.DEFINES)
        elif tag == "call":
            self._name(element, "macro", NameKind.MACRO, Role.NAMES)
        elif tag == "include":
            self.included.append(Included((element.get("filename") or "").strip(), by_xacro=True))
        elif tag not in _DIRECTIVES:
            self._call(element, tag)

    def _call(self, element: Element, macro: str) -> None:
        for span in (element.name_span, element.end_name_span):
            if span is not None and span.text == element.tag:
                start = span.start + len(PREFIX)
                kinds = (NameKind.MACRO,)
                self.names.append(WrittenName(kinds, macro, start, span.end, Role.NAMES))

    def _name(self, element: Element, attribute: str, kind: NameKind, role: Role) -> None:
        text = verbatim(element.attribute(attribute))
        if text is not None and text.value:
            start = text.span.start
            name = text.value
            if kind is NameKind.MACRO and name.startswith(PREFIX):
                name, start = name.removeprefix(PREFIX), start + len(PREFIX)
            self.names.append(WrittenName((kind,), name, start, text.span.end, role))

    def _macro(self, element: Element) -> frozenset[str]:
        self._name(element, "name", NameKind.MACRO, Role.DEFINES)
        params = verbatim(element.attribute("params"))
        if params is None:
            return frozenset()
        names = set()
        for match in _PARAMETER.finditer(params.value):
            names.add(match["name"])
            start = params.span.start
            if match["outer"] is not None:
                self._inherited(match, start)
            group = next((key for key in "abc" if match[key] is not None), "")
            if group:
                self.values.add(match[group])
                self.names += names_in(match[group], start + match.start(group), match["name"])
        self.parameters |= names
        return frozenset(names)

    def _inherited(self, match: re.Match[str], start: int) -> None:
        """Note a parameter that takes the caller's property of its own name."""
        name = f"${{{match['name']}}}"
        at = start + match.start("name")
        kinds = (NameKind.PROPERTY,)
        self.names.append(WrittenName(kinds, name, at, at + len(match["name"]), Role.NAMES))

    def _value(self, text: Located[str], key: str) -> None:
        self.values.add(text.value)
        self.values.update(_BLANKS.split(text.value) if len(text.value) < 1000 else ())
        # What a macro or property does with a value is not known: its name may be a link's.
        self.names += names_in(text.value, text.span.start, key if kinds_of(key) else "")

    def _expressions(self, text: Located[str], shadowed: frozenset[str]) -> None:
        start = text.span.start
        arguments = (_ARGUMENT, _COMPOSED_ARGUMENT, _FUNCTION_ARGUMENT)
        for match in (it for pattern in arguments for it in pattern.finditer(text.value)):
            kinds = (NameKind.ARGUMENT,)
            at, end = start + match.start(1), start + match.end(1)
            self.names.append(WrittenName(kinds, match[1], at, end, Role.NAMES))
        for match in _EXPRESSION.finditer(text.value):
            self.names += self._in_expression(match[1], start + match.start(1), shadowed)

    def _in_expression(
        self, code: str, start: int, shadowed: frozenset[str]
    ) -> Iterator[WrittenName]:
        """Yield the properties in an expression, and the parts that its strings may name."""
        blanked = code
        for match in _QUOTED.finditer(code):
            group = 1 if match[1] is not None else 2
            text = match[group]
            self.values.add(text)
            blanked = blanked[: match.start()] + " " * len(match[0]) + blanked[match.end() :]
            if text and not is_composed(text):
                at, end = start + match.start(group), start + match.end(group)
                yield WrittenName(ANY_PART, text, at, end, Role.MAY_NAME)
        for match in _IDENTIFIER.finditer(blanked):
            if match[0] not in shadowed and not keyword.iskeyword(match[0]):
                at, end = start + match.start(), start + match.end()
                yield WrittenName((NameKind.PROPERTY,), match[0], at, end, Role.MAY_NAME)
