"""Findings, and what they consist of: places in files, severities, fixes."""

from __future__ import annotations

import enum
import hashlib
import re
from collections.abc import Iterable

from checker.base.record import Record

# Fingerprints: they identify a fault while its lines move.


_LINE_NUMBER = re.compile(r"\bline \d+")


def fingerprint(*parts: str) -> str:
    """Return 16 hexadecimal digits that represent these texts in this order."""
    return hashlib.sha256("\0".join(parts).encode(errors="surrogatepass")).hexdigest()[:16]


def without_line_numbers(message: str) -> str:
    """Return a message in which no number changes when lines move."""
    return _LINE_NUMBER.sub("line", message)


def numbered(bases: Iterable[str]) -> list[str]:
    """Return fingerprints that are all different: the second of one base gets a number, …."""
    seen: dict[str, int] = {}
    distinct = []
    for base in bases:
        number = seen.get(base, 0)
        seen[base] = number + 1
        distinct.append(fingerprint(base, str(number)) if number else base)
    return distinct


SNIPPET_LIMIT = 240
"""Characters of a line that a place keeps."""


class Severity(enum.StrEnum):
    """The severity of a finding on the target (see docs/severity.md).

    `ERROR`: the robot or its interface does not load, move, collide, weigh, sense or publish as
    written, or a required part of a submission is missing. `WARNING`: probably not what the author
    intends, or off the checklist, and it works. `INFO`: worth knowing.
    """

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"

    @property
    def rank(self) -> int:
        """0 for the most severe, so that sorting puts errors first."""
        return list(Severity).index(self)

    @property
    def weaker(self) -> Severity:
        """The next less severe one; information stays what it is."""
        return Severity.WARNING if self is Severity.ERROR else Severity.INFO


class Concern(enum.StrEnum):
    """Concern of a finding.

    `ROBOT`: what is simulated. `INTERFACE`: sensors, plugins, launch files and topics, by which it
    is used. `PAPERWORK`: files, sheets, names and installation. `PORTABILITY`: other releases and
    tools.
    """

    ROBOT = "robot"
    INTERFACE = "interface"
    PAPERWORK = "paperwork"
    PORTABILITY = "portability"

    @property
    def label(self) -> str:
        """The concern in words."""
        return str(self) if self is Concern.PORTABILITY else f"the {self}"


class Place(Record):
    """A stretch of one file.

    Attributes:
        file: Path relative to the package folder, with `/`; a sibling's file starts with `../`.
            Empty for the package folder itself.
        line: First line, counted from 1.
        column: First column, counted from 1 in characters.
        end_line: Last line.
        end_column: Column behind the last character.
        element: Path of the XML element (`sdf/model[rover]/link[wheel]`), else empty.
        note: What this place has to do with the finding, when it is not the main one.
        snippet: The line's text, so that a report can show it without the file.
        message: What is wrong here, where it differs from what is stated about the first place.
    """

    file: str
    line: int = 1
    column: int = 1
    end_line: int = 1
    end_column: int = 1
    element: str = ""
    note: str = ""
    snippet: str = ""
    message: str = ""

    def __str__(self) -> str:
        """Return the place as editors and terminals understand it."""
        return f"{self.file or '.'}:{self.line}:{self.column}"


class Safety(enum.StrEnum):
    """Safety of a fix: it keeps the meaning (`SAFE`) or changes behaviour (`UNSAFE`)."""

    SAFE = "safe"
    UNSAFE = "unsafe"


class Edit(Record):
    """Replace the text at `place` by `replacement`.

    Attributes:
        place: The place of the text.
        replacement: The new text.
        original: What is there. Where the file contains something else, as a spawner does that
            puts a text together, the edit cannot be made.
    """

    place: Place
    replacement: str
    original: str


class Fix(Record):
    """Text edits that together correct a finding."""

    safety: Safety
    edits: tuple[Edit, ...]
