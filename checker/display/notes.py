"""What is not shown, as sentences: each once, and not more than anybody reads."""

from __future__ import annotations

from dataclasses import dataclass, field

from checker.report.wording import plain, shortened

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
