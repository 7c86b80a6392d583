"""XML with places: lxml's tree, and expat's positions of everything in it.

lxml gives the line where a start tag ends and no column; expat gives the byte where each tag
begins and ends, but builds no tree. Both read the same text and are joined by document order.
Entities, document types and network access are off in both.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from functools import cached_property

from lxml import etree
from msgspec import field
from msgspec.structs import replace

from checker.base.record import Record
from checker.source.text import Located, SourceText, Span, blank_markup
from checker.source.xml_positions import TagPosition, XmlFault
from checker.source.xml_tags import AttributeSpans, locate_tags, namespace_faults, scan_start_tag

MAX_DEPTH = 250
ELEMENTS_LIMIT = 50_000
"""Greatest number per document; real ones have up to 3 705. Each takes up to 9 kB as a robot."""
ELEMENTS_VARIABLE = "SUBT_CHECK_ELEMENTS"
"""Environment variable that states another limit of elements, for machines with more memory."""
ATTRIBUTES_FOR_ONE = 2
"""Attributes that a document may have for each element that it may have; the largest of 5 000 real
ones has 4 346. Each takes up to 2.5 kB where a rule reports it."""
_PATH_LIMIT = 400
"""Characters of an element's path; what is longer keeps its end."""
_BLANKS = " \t\r\n"
"""XML's own; a no-break space is none of them."""


class XmlDocument(Record, eq=False, dict=True):
    """A well-formed XML text.

    Attributes:
        source: The text that was parsed.
        root: The outermost element.
        tolerated: Faults that Gazebo's reader (tinyxml2) forgives and strict ones do not.
    """

    source: SourceText
    tree: etree._Element
    positions: list[TagPosition]
    tolerated: tuple[XmlFault, ...] = ()

    @cached_property
    def _by_node(self) -> dict[etree._Element, Element]:
        elements: dict[etree._Element, Element] = {}
        for node, position in zip(self.tree.iter(etree.Element), self.positions, strict=True):
            above = node.getparent()
            parent = elements[above] if above is not None else None
            elements[node] = element = Element(self, node, position, position.tag, parent)
            if parent is not None:
                parent.children.append(element)
        return elements

    @cached_property
    def twins(self) -> dict[etree._Element, int]:
        """The number, from 1, of each nameless element among its likes under one parent."""
        groups: dict[object, list[etree._Element]] = {}
        for node in self._by_node:
            if node.get("name") is None:
                groups.setdefault((node.getparent(), node.tag), []).append(node)
        alike = (group for group in groups.values() if len(group) > 1)
        return {node: number for group in alike for number, node in enumerate(group, 1)}

    @cached_property
    def elements(self) -> list[Element]:
        """All elements, in document order."""
        return list(self._by_node.values())

    @property
    def root(self) -> Element:
        """The outermost element."""
        return self.elements[0]

    def element_of(self, node: etree._Element) -> Element:
        """Return the element that represents a node of lxml's tree (as XPath returns it)."""
        return self._by_node[node]

    def find_all(self, xpath: str) -> list[Element]:
        """Return the elements that an XPath expression selects, in document order."""
        nodes = self.tree.xpath(xpath)
        if not isinstance(nodes, list):
            return []
        return [self.element_of(node) for node in nodes if isinstance(node, etree._Element)]

    def written(self, element: Element) -> Element:
        """Return the element of a file that one of this document is a copy of; see `Element`."""
        return element


def elements_limit() -> int:
    """Return how many elements a document may have."""
    said = os.environ.get(ELEMENTS_VARIABLE, "")
    return int(said) if said.isdecimal() and said.isascii() and len(said) < 10 else ELEMENTS_LIMIT


def elements_in(text: str) -> int:
    """Return how many elements a text has, at most: counted in a moment, before it is parsed."""
    return text.count("<") - text.count("</") - text.count("<!") - text.count("<?")


def attributes_in(text: str) -> int:
    """Return how many attributes a text has, at most."""
    return text.count("=")


def parse_xml(source: SourceText) -> XmlDocument | XmlFault:
    """Parse a text, or state why it is not well-formed XML.

    expat judges what is well-formed. What lxml alone objects to (namespaces) is tolerated.
    """
    located = locate_tags(source, MAX_DEPTH)
    if isinstance(located, XmlFault):
        return located
    # Without document types, and with the depth known, huge texts do no harm.
    parser = etree.XMLParser(
        encoding="utf-8",
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        huge_tree=True,
        recover=True,
    )
    tree = etree.fromstring(located.text.encode("utf-8"), parser)
    count = sum(1 for _ in tree.iter(etree.Element)) if tree is not None else 0
    if count != len(located.tags):
        reason = parser.error_log[0].message if len(parser.error_log) else "the tree is incomplete"
        return XmlFault(source.whole(), reason)
    document = XmlDocument(source, tree, located.tags, located.tolerated)
    if not len(parser.error_log):
        return document
    return replace(document, tolerated=(*located.tolerated, *namespace_faults(document)))


class Tagged:
    """Base of records that an element describes: their place is its start tag."""

    __slots__ = ()
    element: Element

    @property
    def span(self) -> Span:
        """The start tag."""
        return self.element.span


class Element(Record, eq=False, dict=True):
    """One element of an XML document, with the places of its parts.

    Attributes:
        tag: Name as written, with its prefix (`xacro:macro`).
        parent: The element around this one.
        children: The elements directly below, in order; comments are left out.
    """

    document: XmlDocument
    node: etree._Element
    position: TagPosition
    tag: str
    parent: Element | None
    children: list[Element] = field(default_factory=list)

    @property
    def source(self) -> SourceText:
        """The text that contains this element."""
        return self.document.source

    @property
    def written(self) -> Element:
        """The element of a file that a macro made this one of; itself where none did."""
        return self.document.written(self)

    @cached_property
    def path(self) -> str:
        """Path by tags and names: `sdf/model[rover]/link[wheel]/pose`."""
        label = self.tag
        name = self.node.get("name")
        if name is not None:
            label += f"[{name}]"
        elif (twin := self.document.twins.get(self.node)) is not None:
            label += f"[{twin}]"
        parent = self.parent
        path = f"{parent.path}/{label}" if parent is not None else label
        return path if len(path) <= _PATH_LIMIT else f"…{path[-_PATH_LIMIT:]}"

    @cached_property
    def span(self) -> Span:
        """The start tag."""
        return Span(self.source, self.position.start, self.position.start_end, self)

    @property
    def whole_span(self) -> Span:
        """The element from the start of its start tag to the end of its end tag."""
        return Span(self.source, self.position.start, self.position.end, self)

    @cached_property
    def _scanned(self) -> AttributeSpans:
        return scan_start_tag(self.source.text, self.position.start, self.position.start_end)

    @property
    def name_span(self) -> Span:
        """The tag's name within the start tag."""
        start, end = self._scanned.tag
        return Span(self.source, start, end, self)

    @property
    def end_name_span(self) -> Span | None:
        """The tag's name within the end tag; None for `<a/>`."""
        if self.source.text[self.position.start_end - 2 : self.position.start_end] == "/>":
            return None
        start = self.position.end_start + len("</")
        return Span(self.source, start, start + len(self.name_span.text), self)

    def all(self, tag: str) -> list[Element]:
        """Return the children of one name."""
        return [child for child in self.children if child.tag == tag]

    def child(self, *path: str) -> Element | None:
        """Return the first child of a name; with several names, go down step by step."""
        element: Element | None = self
        for tag in path:
            element = next((c for c in element.children if c.tag == tag), None) if element else None
        return element

    def at(self, path: str) -> list[Element]:
        """Return all elements at a path below: `a/b`, for each `a` each of its `b`."""
        found = [self]
        for tag in path.split("/"):
            found = [child for element in found for child in element.all(tag)]
        return found

    def descendants(self, tag: str | None = None) -> Iterator[Element]:
        """Yield the elements below this one, in document order."""
        for node in self.node.iterdescendants(etree.Element):
            element = self.document.element_of(node)
            if tag is None or element.tag == tag:
                yield element

    @property
    def attributes(self) -> Mapping[str, str]:
        """Attribute values by their names as written; declarations of namespaces are none."""
        return self.position.attributes

    def get(self, attribute: str, default: str | None = None) -> str | None:
        """Return an attribute's value without its place."""
        return self.node.get(attribute, default)

    def attribute(self, name: str) -> Located[str] | None:
        """Return an attribute's value and its place, or None if it is absent."""
        value = self.attributes.get(name)
        if value is None:
            return None
        return Located(value, self._attribute_span(name, 1))

    def attribute_name_span(self, name: str) -> Span:
        """Return the place of an attribute's name."""
        return self._attribute_span(name, 0)

    def whole_attribute_span(self, name: str) -> Span:
        """Return the place of an attribute, of its quotes, and of the blanks in front of it."""
        text, start = self.source.text, self._attribute_span(name, 0).start
        while text[start - 1].isspace():
            start -= 1
        return Span(self.source, start, self._attribute_span(name, 1).end + 1, self)

    def _attribute_span(self, name: str, part: int) -> Span:
        """Return the name (`part` 0) or the value (1) of an attribute, else the start tag."""
        spans = self._scanned.attributes.get(name)
        if spans is None:
            return self.span
        start, end = spans[part]
        return Span(self.source, start, end, self)

    @property
    def raw_text(self) -> str:
        """Text up to the first child element, blanks included."""
        parts = [self.node.text or ""]
        for node in self.node.iterchildren():
            if isinstance(node.tag, str):
                break
            parts.append(node.tail or "")
        return "".join(parts)

    @property
    def comment_in_front(self) -> Located[str] | None:
        """The comment right in front, with only blanks between; its place is the tag."""
        node = self.node.getprevious()
        if not isinstance(node, etree._Comment) or (node.tail or "").strip(_BLANKS):
            return None
        return Located((node.text or "").strip(_BLANKS), self.span)

    @property
    def stray_texts(self) -> Iterator[Span]:
        """Text between the elements inside: leftovers, where the format knows no mixed content."""
        children = self.children
        starts = [self.position.start_end, *(child.position.end for child in children)]
        ends = [*(child.position.start for child in children), self.position.end_start]
        for start, end in zip(starts, ends, strict=True):
            text = blank_markup(self.source.text[start:end])
            if children and (inner := text.strip(_BLANKS)):
                first = start + text.index(inner)
                yield Span(self.source, first, first + len(inner), self)

    @property
    def value(self) -> str:
        """Text without the blanks around it, and without its place."""
        return self.raw_text.strip(_BLANKS)

    @cached_property
    def text(self) -> Located[str]:
        """Text without the blanks around it; its place is the start tag when there is none."""
        value = self.value
        if not value:
            return Located("", self.span, stated=False)
        return Located(value, self.text_span)

    @property
    def text_span(self) -> Span:
        """Span of the text, from its first to its last character that is no blank.

        Comments, processing instructions and the brackets of CDATA at its ends are left out.
        """
        start = self.position.start_end
        end = self.children[0].position.start if self.children else self.position.end_start
        text = blank_markup(self.source.text[start:end])
        if not text.strip(_BLANKS):
            return self.span
        start, end = (
            start + len(text) - len(text.lstrip(_BLANKS)),
            start + len(text.rstrip(_BLANKS)),
        )
        return Span(self.source, start, end, self)
