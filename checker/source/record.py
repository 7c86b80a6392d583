"""Dataclasses that are made by the thousand for each package."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeVar, dataclass_transform

T = TypeVar("T")


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
def record(*, eq: bool = True, slots: bool = False) -> Callable[[type[T]], type[T]]:
    """Make a dataclass that type checkers hold to be frozen.

    A `dataclass(frozen=True)` refuses assignments when the program runs as well, which takes its
    `__init__` four times as long; 12 000 of them are made for a package.

    Args:
        eq: Compare and hash by the fields, else by identity.
        slots: Keep the fields in slots, not in a `__dict__`.
    """
    return dataclass(eq=eq, slots=slots, unsafe_hash=eq)
