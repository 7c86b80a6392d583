"""Requests that are refused: why, and what to do instead."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(eq=False)
class Refused(Exception):
    """A request that is answered by no.

    Attributes:
        status: The HTTP status.
        error: What is wrong, a sentence.
        advice: What to do about it, a sentence.
        cause: The cause for the metrics, one of few words.
        headers: The headers of the answer.
    """

    status: int
    error: str
    advice: str
    cause: str = "request"
    headers: Mapping[str, str] = field(default_factory=dict)


def sentence(words: str) -> str:
    """Return words as a sentence, from a capital letter to a dot."""
    return f"{words[:1].upper()}{words[1:]}."


def not_found() -> Refused:
    """Return the one answer to every address that leads nowhere; it states nothing of why."""
    return Refused(
        404,
        "Nothing is at this address.",
        "Check the link; a check is deleted after the number of days on its page.",
        "not found",
    )
