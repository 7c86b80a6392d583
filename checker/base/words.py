"""Words for counts and lists, and user text made safe to print."""

from __future__ import annotations

import itertools
import re
from collections.abc import Container, Iterable, Sequence
from difflib import SequenceMatcher, get_close_matches

# Did you mean: the known word that a misspelt one may represent.


EFFORT = 200_000
"""Comparisons of words in all: some 0.3 s. A file may contain thousands of unknown names."""


SLIP = 2
"""Characters that a misspelling adds, leaves out or changes; two change places."""


def is_slip(word: str, known: str) -> bool:
    """Return whether a word may be a misspelling of a known one."""
    if word.casefold() == known.casefold():
        return True
    changes = [
        (word[a:b], known[c:d])
        for change, a, b, c, d in SequenceMatcher(None, word, known, autojunk=False).get_opcodes()
        if change != "equal"
    ]
    is_small = sum(max(map(len, change)) for change in changes) <= SLIP
    return is_small and not any(map(str.isdigit, "".join("".join(change) for change in changes)))


class Suggestions:
    """Known words, among which misspelt ones are looked up until the effort is used up."""

    def __init__(self, known: Iterable[str]) -> None:
        self._known = tuple(dict.fromkeys(known))
        self._found: dict[str, str | None] = {}
        self._sure: dict[str, str | None] = {}
        self._hints: dict[str, str] = {}
        self._effort = EFFORT

    def closest(self, word: str) -> str | None:
        """Return the known word that is nearest to another, if one is near enough."""
        if word not in self._found and self._effort >= len(self._known):
            self._effort -= len(self._known)
            matches = get_close_matches(word[:200], self._known, n=1, cutoff=0.8)
            self._found[word] = matches[0] if matches else None
        return self._found.get(word)

    def correction(self, word: str) -> str | None:
        """Return the one known word of which another is a misspelling; None if several may be.

        A fix writes it: at most `SLIP` characters differ, and no digit, which distinguishes parts.
        """
        if word not in self._sure and self.closest(word) is not None:
            matches = get_close_matches(word[:200], self._known, n=len(self._known), cutoff=0.8)
            slips = [known for known in matches if is_slip(word, known)]
            self._sure[word] = slips[0] if len(slips) == 1 else None
        return self._sure.get(word)

    def hint(self, word: str) -> str:
        """Return the end of a message: `; did you mean 'wheel'?`, or nothing."""
        if word not in self._hints:
            near = self.closest(word) or self._longer(word)
            self._hints[word] = f"; did you mean {near!r}?" if near else ""
        return self._hints[word]

    def _longer(self, word: str) -> str | None:
        """Return the one known word that continues another: `claw_joint` for `claw`."""
        if self._effort < len(self._known):
            return None
        longer = [known for known in self._known if known.startswith(f"{word}_")]
        return longer[0] if len(longer) == 1 else None


# Values in a sentence.


def or_list(values: Iterable[float]) -> str:
    """Return numbers as a choice: `512, 1024 or 2048`."""
    words = [f"{value:g}" for value in values]
    return " or ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


_EXACT = 17
"""Digits that no number has more of."""


def beyond(value: float, *limits: float, digits: int = 2) -> str:
    """Return a number with enough digits to tell it from limits beyond which it is.

    Args:
        value: The number.
        limits: What a message compares it with.
        digits: Digits that it has in any case.
    """
    for more in range(digits, _EXACT):
        text = f"{value:.{more}g}"
        if all(
            (float(text) > it) == (value > it) and (float(text) < it) == (value < it)
            for it in limits
        ):
            return text
    return repr(value)


_CONTROL = re.compile(
    r"[\x00-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff\ud800-\udfff]"
)


def count(number: int, noun: str) -> str:
    """Return `1 error`, `2 errors`."""
    return f"{number} {noun}" + ("" if number == 1 else "s")


def and_list(words: Sequence[str]) -> str:
    """Return `a`, `a and b`, `a, b and c`."""
    if len(words) < 2:
        return "".join(words)
    return ", ".join(words[:-1]) + " and " + words[-1]


def free_number(stem: str, taken: Container[str]) -> int:
    """Return the least number from 2 on for which `stem_2` is not taken."""
    return next(number for number in itertools.count(2) if f"{stem}_{number}" not in taken)


def plain(text: str) -> str:
    """Replace characters that would steer a terminal: escapes, line breaks, bidi marks.

    Halves of surrogate pairs, which represent bytes of file names that are no text, go too. A tab
    becomes a space.
    """
    return _CONTROL.sub("\N{REPLACEMENT CHARACTER}", text.replace("\t", " "))


def shortened(text: str, limit: int) -> str:
    """Return a text, or its beginning with an ellipsis when it is longer than `limit`."""
    return str(text) if len(text) <= limit else text[: limit - 1] + "…"
