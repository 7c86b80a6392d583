"""Dataclasses that are quick to make: those of all parts of a package."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields
from typing import Any, TypeVar, dataclass_transform

T = TypeVar("T")


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
def record(*, eq: bool = True, slots: bool = False) -> Callable[[type[T]], type[T]]:
    """Make a dataclass that type checkers hold to be frozen.

    A `dataclass(frozen=True)` refuses assignments when the program runs as well. That takes its
    `__init__` four times as long, and 12 000 of them are made for a package; the class itself takes
    twice as long, and three hundred classes were a third of the time to load the checker.

    Args:
        eq: Compare and hash by the fields, else by identity.
        slots: Keep the fields in slots, not in a `__dict__`.
    """

    def made(kind: type[T]) -> type[T]:
        if "__repr__" not in vars(kind):
            kind.__repr__ = _shown  # type: ignore[method-assign]
        return dataclass(eq=eq, slots=slots, unsafe_hash=eq, repr=False)(kind)

    return made


def _shown(self: Any) -> str:
    """Return what a dataclass shows of itself; one for all, as code for each takes its time."""
    said = (f"{each.name}={getattr(self, each.name)!r}" for each in fields(self) if each.repr)
    return f"{type(self).__qualname__}({', '.join(said)})"
