"""What is said about a package: places in files, severities, fixes."""

from __future__ import annotations

import enum

from checker.record import record

SNIPPET_LIMIT = 240
"""Characters of a line that a place keeps."""


class Severity(enum.StrEnum):
    """How grave a finding is.

    `ERROR`: the package cannot be accepted or will not work. `WARNING`: a reviewer would ask
    about it. `INFO`: worth knowing.
    """

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"

    @property
    def rank(self) -> int:
        """0 for the gravest, so that sorting puts errors first."""
        return list(Severity).index(self)


@record(slots=True)
class Place:
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
    """

    file: str
    line: int = 1
    column: int = 1
    end_line: int = 1
    end_column: int = 1
    element: str = ""
    note: str = ""
    snippet: str = ""

    def __str__(self) -> str:
        """Give the place as editors and terminals understand it."""
        return f"{self.file or '.'}:{self.line}:{self.column}"


class Safety(enum.StrEnum):
    """Whether a fix keeps the meaning (`SAFE`) or changes behaviour (`UNSAFE`)."""

    SAFE = "safe"
    UNSAFE = "unsafe"


@record(slots=True)
class Edit:
    """Replace the text at `place` by `replacement`.

    Attributes:
        place: Where the text stands.
        replacement: What shall stand there.
        original: What stands there. Where the file holds something else, as a spawner does that
            puts a text together, the edit cannot be made.
    """

    place: Place
    replacement: str
    original: str


@record(slots=True)
class Fix:
    """Text edits that together mend a finding."""

    safety: Safety
    edits: tuple[Edit, ...]
