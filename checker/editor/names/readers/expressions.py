"""Names that are composed of expressions: `${prefix}wheel`, `$(arg name)/odom`, `#{side}_arm`."""

from __future__ import annotations

import re
from collections.abc import Container, Iterator
from functools import lru_cache

EXPRESSION = re.compile(r"\$\{[^{}]{0,400}\}|\$\([^()]{0,400}\)|#\{[^{}]{0,400}\}")
_NAME_LIMIT = 200
"""Characters; a longer text is not compared with composed names."""
_PIECES_LIMIT = 12
"""Greatest number of pieces compared; of more, only both ends must fit."""
_NUMBER = re.compile(r"[+-]?\d+(?:\.\d+)?")


def is_composed(name: str) -> bool:
    """Return whether a name contains an expression."""
    return ("$" in name or "#{" in name) and EXPRESSION.search(name) is not None


@lru_cache(4096)
def literal_pieces(name: str) -> tuple[str, ...]:
    """Return what is around the expressions of a name: `("", "_wheel")`."""
    return tuple(EXPRESSION.split(name))


def expressions(name: str) -> tuple[str, ...]:
    """Return the expressions of a name."""
    return tuple(EXPRESSION.findall(name))


def is_computed(name: str) -> bool:
    """Return whether a name is an expression as a whole: `${name}`."""
    return not any(literal_pieces(name))


def may_come_to(composed: str, name: str, values: Container[str] | None) -> bool:
    """Return whether the expressions of a composed name may make it another name.

    Args:
        composed: The text, such as `${side}_wheel`.
        name: The name, such as `left_wheel`.
        values: The possible values of each expression, numbers aside; None for any value.
    """
    pieces = literal_pieces(composed)
    if len(name) > _NAME_LIMIT or not _fits_at_its_ends(pieces, name):
        return False
    if len(pieces) > _PIECES_LIMIT:
        return True
    reached = {len(pieces[0])}
    for piece in pieces[1:-1]:
        reached = {
            at + len(piece)
            for start in reached
            for at in _places(name, piece, start)
            if _is_value(name[start:at], values)
        }
    last = len(name) - len(pieces[-1])
    return any(start <= last and _is_value(name[start:last], values) for start in reached)


def _fits_at_its_ends(pieces: tuple[str, ...], name: str) -> bool:
    first, last = pieces[0], pieces[-1]
    long_enough = len(name) >= len(first) + len(last)
    return long_enough and name.startswith(first) and name.endswith(last)


def _places(name: str, piece: str, start: int) -> Iterator[int]:
    if not piece:
        yield from range(start, len(name) + 1)
        return
    at = name.find(piece, start)
    while at >= 0:
        yield at
        at = name.find(piece, at + 1)


def _is_value(text: str, values: Container[str] | None) -> bool:
    return values is None or text in values or _NUMBER.fullmatch(text) is not None
