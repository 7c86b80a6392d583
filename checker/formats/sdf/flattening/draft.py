"""A model whose parts are moved, and the changes of one element's text, written out at once."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from html import escape

from checker.base.record import Record
from checker.finding import Edit
from checker.formats.sdf.flattening.names import FlatNames
from checker.model.frames import MODEL_FRAME
from checker.source.text import Located, SourceText, Span
from checker.source.xml import Element
from checker.source.xml_insertion import insertion, with_attributes, with_blanks

Change = tuple[int, int, str]
"""Characters from the first offset up to the second, and what is to be there."""


@dataclass
class Draft:
    """Changes of a text that do not overlap."""

    source: SourceText
    changes: list[Change] = field(default_factory=list)

    def put(self, span: Span, text: str) -> None:
        """Replace a stretch by a text."""
        self.changes.append((span.start, span.end, text))

    def name(self, named: Located[str] | None, new: str) -> None:
        """Replace a name."""
        if named is not None and named.stated and named.value != new:
            self.put(named.span, escape_xml(new))

    def attribute(self, element: Element, name: str, value: str) -> None:
        """Set an attribute of an element."""
        if element.attribute(name) is not None:
            self.name(element.attribute(name), value)
            return
        for span, text in with_attributes(element, {name: escape_xml(value)}):
            self.put(span, text)

    def take_attribute(self, element: Element, name: str) -> None:
        """Leave out an attribute."""
        self.put(element.whole_attribute_span(name), "")

    def insert(self, parent: Element, line: str) -> None:
        """Insert an element as the first of another one."""
        span, text = insertion(parent, [line])
        self.put(span, text)

    def take_out(self, span: Span) -> None:
        """Leave out a stretch and its line."""
        self.put(with_blanks(span), "")

    def text(self, start: int, end: int) -> str:
        """Return the characters between two offsets with all changes made."""
        pieces, at = [], start
        for first, behind, new in sorted(self.changes):
            if start <= first and behind <= end:
                pieces += [self.source.text[at:first], new]
                at = behind
        return "".join((*pieces, self.source.text[at:end]))

    @property
    def edits(self) -> tuple[Edit, ...]:
        """The changes as edits of the file."""
        return tuple(
            Span(self.source, start, end).replacement(new)
            for start, end, new in sorted(self.changes)
        )


def escape_xml(text: str) -> str:
    """Return a text as it is written in XML, inside of an element or an attribute."""
    return escape(text)


# A model whose parts are being moved, and what they call each other.


_NAMING = {
    "pose": ("relative_to", "frame"),
    "frame": ("attached_to",),
    "xyz": ("expressed_in",),
    "mimic": ("joint",),
    "parent": ("link",),
    "child": ("link",),
}
"""Attributes that name a part, by the elements that have them."""
_NAMED = ("parent", "child", "gearbox_reference_body", "gripper_link", "palm_link")
"""Elements whose text names a part."""


class Holder(Record):
    """A model whose parts are being moved.

    Attributes:
        element: The `<model>`.
        prefix: What is in front of scoped names in it; empty for the robot.
        frame: Scoped name of its own frame.
    """

    element: Element
    prefix: str = ""
    frame: str = MODEL_FRAME

    @property
    def nested(self) -> bool:
        """True if it is a model within the robot's."""
        return self.frame != MODEL_FRAME

    def scoped(self, name: str) -> str:
        """Return the unique name of what is called so inside."""
        if name in ("", MODEL_FRAME):
            return self.frame
        return name if name == "world" else self.prefix + name.removesuffix(f"::{MODEL_FRAME}")

    def rename(self, draft: Draft, part: Element, names: FlatNames) -> None:
        """Rename a part, and the parts that it names."""
        name = part.attribute("name")
        if name is not None:
            draft.name(name, names.changed.get(self.scoped(name.value), name.value))
        for element in (part, *part.descendants()):
            for named in self._named(element):
                scoped = self.scoped(named.value)
                draft.name(named, names.changed.get(scoped, named.value))

    def _named(self, element: Element) -> Iterator[Located[str]]:
        for name in _NAMING.get(element.tag, ()):
            attribute = element.attribute(name)
            # What a nested model's poses name before SDF 1.7 is worked into their numbers.
            if attribute is not None and attribute.value and not (name == "frame" and self.nested):
                yield attribute
        if element.tag in _NAMED and element.text.stated:
            yield element.text
