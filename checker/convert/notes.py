"""What a conversion drops or decides, each with the line it is about."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

from checker.source.text import Span


class Placed(Protocol):
    """Anything that stands somewhere in the source."""

    @property
    def span(self) -> Span:
        """Where."""
        ...


@dataclass
class Notes:
    """Sentences, each once, in the order in which they were said."""

    _said: dict[str, None] = field(default_factory=dict)

    def say(self, where: Placed, what: str) -> None:
        """Note something about a place of the source."""
        place = where.span.place()
        self._said[f"{place.file}:{place.line}: {what}"] = None

    @property
    def all(self) -> tuple[str, ...]:
        """The sentences."""
        return tuple(self._said)
