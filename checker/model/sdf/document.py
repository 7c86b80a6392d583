"""An SDF file as the rules on syntax and schema see it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from checker.model.schema import ElementType, walk
from checker.record import record
from checker.source.xml import Element, XmlDocument


@record(eq=False)
class SdfDocument:
    """A well-formed SDF file.

    Attributes:
        document: Its XML.
        version: The version that `<sdf>` states; empty when it states none.
    """

    document: XmlDocument
    version: str

    @property
    def root(self) -> Element:
        """The `<sdf>` element."""
        return self.document.root

    @cached_property
    def typed_elements(self) -> list[tuple[Element, ElementType | None]]:
        """Each element with its type in the schema; see `checker.model.schema.walk`."""
        return list(walk(self.root, self.version))

    def elements(self) -> Iterator[Element]:
        """Yield the elements that the schema knows, in document order."""
        for element, kind in self.typed_elements:
            if kind is not None:
                yield element
