"""The parts of a package that rules need: their providers, and why one is not available.

A part is found by its type. A function marked `@part` makes it: the type that it returns is that
of the part, and the types of its parameters are those of the parts that it is made of.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from functools import cached_property
from types import NoneType
from typing import Any, Protocol, TypeVar, get_args, get_origin, get_type_hints

from checker.base.record import Record

T = TypeVar("T")
F = TypeVar("F", bound=Callable[..., Any])

_MARK = "__provides_part__"


class NotAvailable(Record):
    """A part of a package that a rule needs and that is not available.

    Attributes:
        reason: The reason, as the end of a sentence.
        applicable: False if the package has no such part and needs none.
    """

    reason: str
    applicable: bool = True


class WorkerFailed(Record):
    """A process gave no result: it crashed, exceeded its limits, or gave an invalid answer.

    Attributes:
        reason: The reason, as the end of a sentence whose subject is the work.
        momentary: Whether the cause is not in the work, so that it may go well the next time: it
            was killed from outside, the machine was too busy, or the disk was full.
    """

    reason: str
    momentary: bool = False

    @property
    def entry(self) -> dict[str, object]:
        """Form in which a process returns it in place of a result (`checker.base.background`)."""
        return {"failed": {"reason": self.reason, "momentary": self.momentary}}


class Parts(Protocol):
    """Gives the parts of a package by the names of their types.

    By names, so that a rule gets them without loading the modules that it is written with.
    """

    def part(self, kind: str) -> Sequence[object] | NotAvailable:
        """Return the part; several when a file contains several robots.

        Args:
            kind: The kind as `type_name` returns it.
        """
        ...


class Ask(Protocol):
    """Gives parts to a function that needs different ones for different packages."""

    def one(self, kind: type[T]) -> T | NotAvailable:
        """Return the part of a type; the first one where there are several."""
        ...

    def all(self, kind: type[T]) -> tuple[T, ...] | NotAvailable:
        """Return all parts of a type; at least one."""
        ...

    def parts_of(self, package: Any) -> AbstractContextManager[Ask]:
        """Return the parts of another package, to compare with."""
        ...


def type_name(kind: type) -> str:
    """Return the module and the name of a type: `checker.model.robot:Robot`."""
    return f"{kind.__module__}:{kind.__qualname__}"


class Need(Record):
    """A part as the annotation of a parameter or result names it.

    Attributes:
        kind: The name of its type.
        several: Whether it is `tuple[Robot, ...]`: all of them, in place of the first.
        optional: Whether it is `… | NotAvailable` or `… | None`.
    """

    kind: str
    several: bool
    optional: bool


def need_of(hint: Any) -> Need:
    """Return the type that an annotation requests."""
    choices = () if get_origin(hint) is tuple else get_args(hint)
    kinds = [each for each in choices if each not in (NotAvailable, NoneType)] or [hint]
    several = get_origin(kinds[0]) is tuple
    kind = get_args(kinds[0])[0] if several else kinds[0]
    return Need(type_name(kind), several, len(kinds) < len(choices))


class Provider(Record, dict=True):
    """A function that makes a part."""

    function: Callable[..., Any]

    @cached_property
    def needs(self) -> Mapping[str, Need]:
        """Parts that the provider or rule needs, by parameter."""
        hints = get_type_hints(self.function)
        return {name: need_of(hints[name]) for name in inspect.signature(self.function).parameters}


def part(function: F) -> F:
    """Mark a function that makes a part.

    It is called once for a package, when the part is first requested. A parameter without
    `| NotAvailable` is never given one: what a part needs and is missing is why that part is, too.
    """
    function.__dict__[_MARK] = True
    return function


def providers_in(module: object) -> dict[str, Provider]:
    """Return the functions of a module that make parts, by the names of the types."""
    functions = filter(inspect.isfunction, vars(module).values())
    marked = [function for function in functions if _MARK in function.__dict__]
    return {need_of(get_type_hints(each)["return"]).kind: Provider(each) for each in marked}
