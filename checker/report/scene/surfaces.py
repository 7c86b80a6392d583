"""Who gives what mesh files look like, and what is said of parts that are not shown."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.physics.mesh.surface import Surface
from checker.source.text import Located

# What is not shown, as sentences: each once, and not more than anybody reads.


SENTENCES = 20
_NAME = 80
"""Characters of a name in a sentence."""


@dataclass
class Notes:
    """Sentences in the order in which they were first said."""

    _said: dict[str, None] = field(default_factory=dict)

    def say(self, sentence: str) -> None:
        """Add a sentence, unless it was said."""
        self._said[sentence] = None

    @property
    def sentences(self) -> tuple[str, ...]:
        """The first ones, and how many more there are."""
        said = tuple(self._said)
        if len(said) <= SENTENCES:
            return said
        rest = len(said) - SENTENCES + 1
        return (*said[: SENTENCES - 1], f"{rest} more parts are not shown")


def short(name: str) -> str:
    """Return a name that a sentence can hold."""
    return plain(shortened(name, _NAME))


class Surfaces(Protocol):
    """Gives what the mesh files of a robot look like."""

    def of(self, uri: Located[str]) -> tuple[Surface, ...] | str:
        """Return what the mesh file behind a URI looks like.

        Metres, its own unit honoured, the model's `<scale>` not applied. Asked again for the same
        file, it returns the same arrays, so that they are stored once. Else why the file cannot be
        shown: the end of a sentence whose subject is the file.
        """
        ...


class NoSurfaces(Record):
    """For a robot whose mesh files nobody reads."""

    def of(self, uri: Located[str]) -> tuple[Surface, ...] | str:  # noqa: ARG002 - as a `Surfaces`
        """Say that the file was not read."""
        return "was not read"
