"""Did you mean: the known word that a misspelt one may stand for."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

EFFORT = 200_000
"""Comparisons of words in all: some 0.3 s. A file may hold thousands of unknown names."""


class Suggestions:
    """Known words, among which misspelt ones are looked up until the effort is used up."""

    def __init__(self, known: Iterable[str]) -> None:
        self._known = tuple(dict.fromkeys(known))
        self._found: dict[str, str | None] = {}
        self._effort = EFFORT

    def near(self, word: str) -> str | None:
        """Return the known word that is nearest to another, if one is near enough."""
        if word not in self._found and self._effort >= len(self._known):
            self._effort -= len(self._known)
            matches = get_close_matches(word[:200], self._known, n=1, cutoff=0.8)
            self._found[word] = matches[0] if matches else None
        return self._found.get(word)

    def hint(self, word: str) -> str:
        """Return the end of a message: `; did you mean 'wheel'?`, or nothing."""
        near = self.near(word)
        return f"; did you mean {near!r}?" if near else ""
