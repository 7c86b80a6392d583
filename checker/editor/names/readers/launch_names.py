"""Names in launch files in XML: arguments, topics, and parameters of nodes."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping

from checker.editor.names.mention import TOPIC_ONLY, NameKind, Role, WrittenName
from checker.editor.names.readers.plugin_names import verbatim
from checker.editor.names.readers.topics import is_topic, topic_key
from checker.editor.names.readers.values import (
    LENGTH_LIMIT,
    STEP_KINDS,
    names_in,
    steps_in,
    words_in,
)
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument

ARGUMENT = (NameKind.ARGUMENT,)
_NAMED = re.compile(r"\$\((?:arg|var)\s+([A-Za-z_]\w*)\s*\)")
_EVALUATED = re.compile(r"\$\(eval\s+(.{0,2000}?)\)(?=\s*$|[^()]*$)", re.DOTALL)
_BEHIND = re.compile(r"\$\((?:arg|var)\s+([A-Za-z_]\w*)\s*\)/([\w.-]+)")
_LAST_ARGUMENT = re.compile(r"\$\((?:arg|var)\s+([A-Za-z_]\w*)\s*\)\Z")
_TAIL = 200
_DEPTH = 4
_NO_NAMES = frozenset(
    {"if", "unless", "name", "pkg", "type", "exec", "file", "ns", "namespace", "doc"}
)
_IDENTIFIER = re.compile(r"(?<![\w.])[A-Za-z_]\w*")


def launch_names(document: XmlDocument) -> Iterator[WrittenName]:
    """Yield the names of a launch file."""
    known = {
        name: element.get("default") or element.get("value") or ""
        for element in document.elements
        if element.tag in ("arg", "let") and (name := element.get("name"))
    }
    for element in document.elements:
        yield from _of_element(element)
        for name in element.attributes:
            text = verbatim(element.attribute(name))
            if text is not None and "$(" in text.value:
                yield from named_arguments(text.value, text.span.start)
                yield from _behind_arguments(text.value, text.span.start, known)


def _of_element(element: Element) -> Iterator[WrittenName]:
    tag = element.tag
    if tag in ("arg", "let"):
        yield from _argument(element)
    for name in element.attributes:
        text = verbatim(element.attribute(name))
        if text is None or name in _NO_NAMES:
            continue
        if tag == "remap":
            yield from _remapped(text)
        else:
            yield from _written_names(element, name, text)
    if tag == "rosparam" and (text := verbatim(element.text)) is not None:
        yield from words_in(text.value, text.span.start)


def _behind_arguments(value: str, start: int, known: Mapping[str, str]) -> Iterator[WrittenName]:
    """Yield the part in `$(arg sensors)/front/scan`, where the argument ends in `/sensor`."""
    for match in _BEHIND.finditer(value[:LENGTH_LIMIT]):
        before = known.get(match[1], "")
        for _ in range(_DEPTH):
            # What an argument ends in may be another one.
            last = _LAST_ARGUMENT.search(before[-_TAIL:])
            before = known.get(last[1], "") if last else before
        kinds = STEP_KINDS.get(before.rstrip("/").rpartition("/")[2])
        if kinds is not None:
            at, end = start + match.start(2), start + match.end(2)
            yield WrittenName(kinds, match[2], at, end, Role.MAY_NAME)


def _argument(element: Element) -> Iterator[WrittenName]:
    """Yield an argument that is declared, set, or passed to a file that is included."""
    text = verbatim(element.attribute("name"))
    if text is None or not text.value:
        return
    above = element.parent
    files: tuple[str, ...] = ()
    role = Role.DEFINES
    if above is not None and above.tag == "include":
        files = (posixpath.basename(above.get("file") or ""),)
        role = Role.MAY_NAME
    yield WrittenName(ARGUMENT, text.value, text.span.start, text.span.end, role, files)


def named_arguments(value: str, start: int) -> Iterator[WrittenName]:
    """Yield the arguments in `$(arg x)`, `$(var x)` and `$(eval …)` of a text."""
    if "$(" not in value or len(value) > LENGTH_LIMIT:
        return
    for match in _NAMED.finditer(value):
        at, end = start + match.start(1), start + match.end(1)
        yield WrittenName(ARGUMENT, match[1], at, end, Role.NAMES)
    for evaluated in _EVALUATED.finditer(value):
        for match in _IDENTIFIER.finditer(evaluated[1]):
            at = start + evaluated.start(1) + match.start()
            if match[0] not in ("arg", "var", "and", "or", "not", "if", "else"):
                yield WrittenName(ARGUMENT, match[0], at, at + len(match[0]), Role.MAY_NAME)


def _remapped(text: Located[str]) -> Iterator[WrittenName]:
    yield from steps_in(text.value, text.span.start)
    if is_topic(text.value):
        key, own = topic_key(text.value)
        start = text.span.start
        end = start + len(text.value)
        yield WrittenName(TOPIC_ONLY, key, start + own, end, Role.MAY_NAME)


def _written_names(element: Element, name: str, text: Located[str]) -> Iterator[WrittenName]:
    """Yield what an attribute of a node, parameter or argument may name."""
    key = name
    if name in ("value", "default"):
        key = posixpath.basename(element.get("name") or "")
    words = name in ("args", "command", "ros_args", "cmd")
    yield from names_in(text.value, text.span.start, key, words=words)
