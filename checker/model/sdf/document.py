"""An SDF file as the rules on syntax and schema see it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property

from checker.base.record import Record
from checker.model.sdf.schema import ElementType, walk
from checker.source.xml import Element, XmlDocument

# The SDF version of a file: one reading of it for everything that depends on it.


FALLBACK = (1, 6)
"""What a file without a readable version is read as."""

_VERSION = re.compile(r"\s*(\d{1,4})\.(\d{1,4})\s*", re.ASCII)


def sdf_version(document: XmlDocument) -> tuple[int, int]:
    """Return the version that `<sdf>` states, as (1, 6); (1, 6) when it cannot be read."""
    return parse_version(document.root.get("version") or "") or FALLBACK


def parse_version(text: str) -> tuple[int, int] | None:
    """Read `1.6`, blanks around it aside; None for anything else."""
    match = _VERSION.fullmatch(text)
    return (int(match[1]), int(match[2])) if match else None


class SdfDocument(Record, eq=False, dict=True):
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
        """Each element with its type in the schema; see `checker.model.sdf.schema.walk`."""
        return list(walk(self.root, self.version))

    def elements(self) -> Iterator[Element]:
        """Yield the elements that the schema knows, in document order."""
        for element, kind in self.typed_elements:
            if kind is not None:
                yield element
