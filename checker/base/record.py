"""Records: immutable values of which a package's parts are made."""

from __future__ import annotations

from typing import dataclass_transform

import msgspec

_SHOWN = 900
"""Characters that a record shows of itself."""
_DEPTH = 2


@dataclass_transform(frozen_default=True, field_specifiers=(msgspec.field,))
class Record(msgspec.Struct, frozen=True):
    """A value with named fields that does not change; compared by them, unless `eq=False` is given.

    Its text stays on one line: what is deep inside is left out, so that a failing assertion about
    one number of a robot does not print the whole robot.
    """

    def __repr__(self) -> str:
        """Show the fields, two levels deep."""
        return _clipped(_text(self, _DEPTH), _SHOWN)


def _text(value: object, depth: int) -> str:
    if not isinstance(value, Record):
        return _clipped(repr(value), 120) if _is_plain(value) else f"<{type(value).__name__}>"
    if depth == 0:
        return f"{type(value).__qualname__}(…)"
    fields = (
        f"{name}={_text(getattr(value, name, None), depth - 1)}" for name in value.__struct_fields__
    )
    return f"{type(value).__qualname__}({', '.join(fields)})"


def _is_plain(value: object) -> bool:
    """Return whether a value's own text is short by nature."""
    if isinstance(value, tuple | list | set | frozenset) and len(value) <= 8:
        return all(isinstance(item, str | int | float | None) for item in value)
    return value is None or isinstance(value, str | bytes | int | float | type)


def _clipped(text: str, limit: int) -> str:
    return text if len(text) <= limit else f"{text[: limit - 1]}…"
