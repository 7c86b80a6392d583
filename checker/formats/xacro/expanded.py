"""An expanded document whose places are those of the files that a person wrote."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

from checker.finding import Place
from checker.formats.xacro.files import ROOT, Gathered
from checker.source.emitted import EmittedText, Piece
from checker.source.text import SourceText, Span
from checker.source.xml import Element, XmlDocument, parse_xml
from checker.source.xml_positions import XmlFault

_BLANKS = " \t\r\n"
_PACKAGES = (f"file:///{ROOT}/", f"file://{ROOT}/", f"file:{ROOT}/")
"""Starts of the URI of a path: `file://$(find p)/`, also with a third slash or without both."""
_BARE = re.compile(rf'(<(?:mesh|texture)\b[^<>]*?\bfilename="){ROOT}/')
"""A mesh or picture that is the path itself, `$(find p)/x`."""


class ExpandedText(SourceText, dict=True, kw_only=True):
    """Text that xacro makes of a file: offsets and lines count in it, places are in the source.

    Attributes:
        plain: The text as a document without places.
        answer: The child's answer: the original of each copied element.
        gathered: The texts that were given to the child.
        written: The file that was expanded.
    """

    plain: XmlDocument
    answer: Mapping[str, Any]
    gathered: Gathered
    written: SourceText

    @cached_property
    def origins(self) -> Sequence[Element | None]:
        """The element that each element of the document is a copy of, in document order."""
        return _origins(self.answer, self.gathered)

    @cached_property
    def _emitted(self) -> EmittedText:
        """The text in pieces; most robots have no fault, so that no place is needed."""
        pieces = tuple(_pieces(self.plain, self.origins, self.written))
        return EmittedText(self.file, self.text, origin=self.written.whole(), pieces=pieces)

    @property
    def parts(self) -> tuple[str, ...]:
        """The files that its elements were written in, as xacro sees them."""
        files = self.answer["files"]
        numbers = dict.fromkeys(number for number, _ in self.answer["origins"])
        return tuple(str(files[number]) for number in numbers if 0 <= number < len(files))

    @property
    def read(self) -> tuple[XmlDocument, ...]:
        """The files that were read to expand it."""
        read = (self.gathered.documents.get(str(path)) for path in self.answer["files"])
        return tuple(document for document in read if document is not None)

    @property
    def left(self) -> tuple[str, ...]:
        """Packages that are not available, whose files are included."""
        return tuple(dict.fromkeys(map(str, self.answer.get("left", ()))))

    @property
    def skipped(self) -> tuple[str, ...]:
        """Macros that are called, and that only these packages may define, in words."""
        names = dict.fromkeys(map(str, self.answer.get("skipped", ())))
        packages = f"{' or '.join(self.left)} (put it next to the package)"
        return tuple(f"macro {name} of {packages}" for name in names)

    def states_path(self, uri: str) -> bool:
        """Return whether a `package://` URI represents the path of a file, `file://$(find p)/x`."""
        text, path = str(self.answer["xml"]), uri.removeprefix("package://")
        ends = (f"{start}{path}{end}" for start in _PACKAGES for end in ('"', "<"))
        return self.states_bare_path(uri) or any(end in text for end in ends)

    def states_bare_path(self, uri: str) -> bool:
        """Return whether it represents a path without a scheme, `$(find p)/x`."""
        return f'filename="{ROOT}/{uri.removeprefix("package://")}"' in str(self.answer["xml"])

    def place(self, start: int, end: int) -> Place:
        """Return the place in a written file of the characters from `start` to `end`."""
        return self._emitted.place(start, end)


class ExpandedDocument(XmlDocument, eq=False, dict=True):
    """A document that xacro made: it knows the elements that its own are copies of."""

    source: ExpandedText

    @cached_property
    def _origins(self) -> Mapping[Element, Element]:
        pairs = zip(self.elements, self.source.origins, strict=True)
        return {copy: origin for copy, origin in pairs if origin is not None}

    def written(self, element: Element) -> Element:
        """Return the element of a file that one of this document is a copy of."""
        return self._origins.get(element, element)


def expanded_document(
    answer: Mapping[str, Any], gathered: Gathered, file: str
) -> XmlDocument | None:
    """Return the document that xacro made of a file; None if it cannot be read.

    Args:
        answer: The child's answer: the text, and for each element the one it is a copy of.
        gathered: The texts that were given to the child.
        file: The expanded file, as xacro saw it.
    """
    # A mesh below `file://$(find p)/` is one of package p, wherever that is installed.
    text = str(answer["xml"])
    for start in _PACKAGES:
        text = text.replace(start, "package://")
    text = _BARE.sub(r"\1package://", text)
    written = gathered.sources[file]
    plain = parse_xml(SourceText(written.file, text))
    if isinstance(plain, XmlFault) or len(plain.positions) != len(answer["origins"]):
        return None
    source = ExpandedText(
        written.file, text, plain=plain, answer=answer, gathered=gathered, written=written
    )
    # The tree and the offsets are the same: only the places differ.
    return ExpandedDocument(source, plain.tree, plain.positions)


def _origins(answer: Mapping[str, Any], gathered: Gathered) -> list[Element | None]:
    """Return the element that each expanded one is a copy of."""
    documents = [gathered.documents.get(path) for path in answer["files"]]
    elements: list[Element | None] = []
    for number, index in answer["origins"]:
        document = documents[number] if 0 <= number < len(documents) else None
        known = document is not None and 0 <= index < len(document.elements)
        elements.append(document.elements[index] if document is not None and known else None)
    return elements


def _pieces(
    document: XmlDocument, origins: Sequence[Element | None], root: SourceText
) -> Iterator[Piece]:
    """Part the text into tags, attribute values and texts, each with what it was made from."""
    text, at = document.source.text, 0
    around: list[Element | None] = []
    for offset, opens, element, origin in _tags(document, origins):
        if offset > at:
            holder = around[-1] if around else None
            yield from _inner_text(text[at:offset], holder, root)
        if opens:
            yield from _start_tag(element, origin, root)
            at = element.position.start_end
            around.append(origin)
        else:
            end = element.position.end
            if end > offset:
                yield Piece(text[offset:end], _end_tag(origin, root))
            at = max(at, end)
            around.pop()


def _tags(
    document: XmlDocument, origins: Sequence[Element | None]
) -> Iterator[tuple[int, bool, Element, Element | None]]:
    """Yield where each element opens and closes, in the order of the text."""
    open_elements: list[tuple[Element, Element | None]] = []
    for element, origin in zip(document.elements, origins, strict=True):
        while open_elements and open_elements[-1][0].position.end <= element.position.start:
            closed, its_origin = open_elements.pop()
            yield closed.position.end_start, False, closed, its_origin
        yield element.position.start, True, element, origin
        open_elements.append((element, origin))
    while open_elements:
        closed, its_origin = open_elements.pop()
        yield closed.position.end_start, False, closed, its_origin


def _start_tag(element: Element, origin: Element | None, root: SourceText) -> Iterator[Piece]:
    text, at, end = element.source.text, element.position.start, element.position.start_end
    tag = origin.span if origin is not None else root.whole()
    for name in element.attributes:
        expanded = element.attribute(name)
        written = origin.attribute(name) if origin is not None else None
        if expanded is None or written is None or not expanded.value:
            continue
        start, stop = expanded.span.start, expanded.span.end
        yield Piece(text[at:start], tag)
        yield Piece(text[start:stop], written.span, literal=written.span.text == text[start:stop])
        at = stop
    yield Piece(text[at:end], tag)


def _end_tag(origin: Element | None, root: SourceText) -> Span:
    if origin is None:
        return root.whole()
    if origin.position.end_start >= origin.position.end:
        return origin.span
    return Span(origin.source, origin.position.end_start, origin.position.end, origin)


def _inner_text(text: str, holder: Element | None, root: SourceText) -> Iterator[Piece]:
    """Yield the text inside an element: as it is written there, or as a whole."""
    if holder is None:
        yield Piece(text, root.whole())
        return
    written = holder.text_span
    inner = text.strip(_BLANKS)
    if not inner or written.text != inner:
        yield Piece(text, written)
        return
    start = text.index(inner)
    if start:
        yield Piece(text[:start], written)
    yield Piece(inner, written, literal=True)
    if rest := text[start + len(inner) :]:
        yield Piece(rest, written)
