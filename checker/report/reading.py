"""Plain JSON read back into dataclasses by their annotations; what does not fit is refused."""

from __future__ import annotations

import binascii
import enum
import re
from base64 import b64decode
from collections.abc import Callable, Mapping
from dataclasses import MISSING, fields, is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import (
    Annotated,
    Any,
    Literal,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
    is_typeddict,
)

T = TypeVar("T")
Read = Callable[[Any], Any]
_GREATEST = 2**63
"""Whole numbers below it are counts and lines; longer ones are nobody's."""


class Unfit(ValueError):
    """JSON that is not what it should be; the text says where and what was expected."""


def read_as(kind: type[T], said: object) -> T:
    """Return a dataclass made of JSON: unknown members are passed over, all others must fit.

    Args:
        kind: A dataclass of texts, numbers, enumerations, bytes (in Base64), tuples, mappings,
            dataclasses, and of each or None; or a TypedDict, of which unknown members are kept.
            A text annotated with a pattern must match all of it, a number annotated with a range
            must lie in it.
        said: As `json.loads` returns it.

    Raises:
        Unfit: Something is missing, or is of another type.
    """
    hint: Any = kind
    made: T = _reader(hint)(said)
    return made


@cache
def _reader(hint: Any) -> Read:
    """Return what reads a type; put together once for each."""
    if hint in _PLAIN:
        return _PLAIN[hint]
    origin = get_origin(hint)
    if origin is not None:
        return _composed(origin, get_args(hint))
    if is_dataclass(hint):
        return _dataclass(hint)
    return _typed_dict(hint) if is_typeddict(hint) else _enumeration(hint)


def _composed(origin: Any, inner: tuple[Any, ...]) -> Read:
    """Return what reads a type that is made of others."""
    if origin is Literal:
        return _one_of(inner)
    if origin in (Union, UnionType):
        return _optional(inner)
    first = _reader(inner[0])
    if origin is Annotated:
        return _restricted(first, inner[1])
    return _mapping(first, _reader(inner[1])) if origin is Mapping else _sequence(origin, first)


def _text(said: Any) -> str:
    if not isinstance(said, str):
        raise Unfit("expected a string")
    return said


def _whole(said: Any) -> int:
    if not isinstance(said, int) or isinstance(said, bool) or not -_GREATEST < said < _GREATEST:
        raise Unfit("expected a whole number")
    return said


def _number(said: Any) -> float:
    return said if isinstance(said, float) else _whole(said)


def _truth(said: Any) -> bool:
    if not isinstance(said, bool):
        raise Unfit("expected true or false")
    return said


def _bytes(said: Any) -> bytes:
    try:
        return b64decode(_text(said), validate=True)
    except binascii.Error:
        raise Unfit("expected Base64") from None


_PLAIN: Mapping[Any, Read] = {
    str: _text,
    int: _whole,
    float: _number,
    bool: _truth,
    bytes: _bytes,
    Any: lambda said: said,
}


def _restricted(plain: Read, allowed: re.Pattern[str] | range) -> Read:
    def read(said: Any) -> Any:
        value = plain(said)
        if isinstance(allowed, range):
            if value not in allowed:
                raise Unfit(f"expected a number from {allowed.start} to {allowed.stop - 1}")
        elif not allowed.fullmatch(value):
            raise Unfit(f"expected a string that matches {allowed.pattern}")
        return value

    return read


def _optional(hints: tuple[Any, ...]) -> Read:
    (inner,) = (_reader(hint) for hint in hints if hint is not NoneType)
    return lambda said: None if said is None else inner(said)


def _one_of(values: tuple[Any, ...]) -> Read:
    def read(said: Any) -> Any:
        if not isinstance(said, str) or said not in values:
            raise Unfit(f"expected one of {', '.join(map(str, values))}")
        return said

    return read


def _enumeration(kind: type[enum.StrEnum]) -> Read:
    known = {str(each): each for each in kind}
    check = _one_of(tuple(known))
    return lambda said: known[check(said)]


def _sequence(kind: Callable[[Any], Any], item: Read) -> Read:
    def read(said: Any) -> Any:
        if not isinstance(said, list | tuple):
            raise Unfit("expected a list")
        return kind([item(each) for each in said])

    return read


def _mapping(key: Read, value: Read) -> Read:
    def read(said: Any) -> dict[str, Any]:
        return {key(name): value(each) for name, each in _object(said).items()}

    return read


def _dataclass(kind: Any) -> Read:
    hints = get_type_hints(kind, include_extras=True)
    readers = {each.name: _reader(hints[each.name]) for each in fields(kind)}
    required = {
        each.name
        for each in fields(kind)
        if each.default is MISSING and each.default_factory is MISSING
    }
    return lambda said: kind(**_members(_object(said), readers, required))


def _typed_dict(kind: Any) -> Read:
    readers = {
        name: _reader(hint) for name, hint in get_type_hints(kind, include_extras=True).items()
    }
    required = set(kind.__required_keys__)

    def read(said: Any) -> dict[str, Any]:
        return {**_object(said), **_members(said, readers, required)}

    return read


def _members(
    said: Mapping[str, Any], readers: Mapping[str, Read], required: set[str]
) -> dict[str, Any]:
    if missing := required - said.keys():
        raise Unfit(f"{min(missing)} is missing")
    made = {}
    for name, read in readers.items():
        if name in said:
            try:
                made[name] = read(said[name])
            except Unfit as fault:
                raise Unfit(f"{name}: {fault}") from None
    return made


def _object(said: Any) -> Mapping[str, Any]:
    if not isinstance(said, dict):
        raise Unfit("expected an object")
    return said
