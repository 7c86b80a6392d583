"""Methods of String; parts of a string keep their origin."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from checker.launch.spawner.limits import MAX_INTEGER_BITS, LimitReached
from checker.launch.spawner.literals import TracedString, join_strings
from checker.launch.spawner.methods.call import Call, Method, Methods
from checker.launch.spawner.signals import RubyError
from checker.launch.spawner.value_text import formatted
from checker.launch.spawner.values import (
    RubyArray,
    RubyRange,
    RubyString,
    Symbol,
    Value,
    class_name,
)

_BLANKS = "\t\n\v\f\r "
_INTEGER = re.compile(r"\s*([+-]?\d{1,400}(?:_\d{1,400})*)")
_FLOAT = re.compile(r"\s*([+-]?\d+(?:_\d+)*(?:\.\d+(?:_\d+)*)?(?:[eE][+-]?\d+)?)")
_MAX_DIGITS = MAX_INTEGER_BITS // 4


def _receiver(call: Call) -> TracedString:
    return call.traced(call.receiver)


def _text(call: Call) -> str:
    return call.text(call.receiver)


def _cut(call: Call, start: int, end: int) -> Value:
    return call.run.string(_receiver(call).cut(start, end))


def _chomp(call: Call) -> Value:
    text = _text(call)
    end = next((end for end in ("\r\n", "\n", "\r") if text.endswith(end)), "")
    return _cut(call, 0, len(text) - len(end))


def _strip(call: Call) -> Value:
    text = _text(call)
    return _cut(call, len(text) - len(text.lstrip(_BLANKS)), len(text.rstrip(_BLANKS + "\0")))


def _at(call: Call, index: Value) -> Value:
    length = len(_text(call))
    if isinstance(index, RubyRange):
        bounds = index.bounds_in(length)
        return _cut(call, *bounds) if bounds else None
    start = call.integer(index)
    start += length if start < 0 else 0
    return _cut(call, start, start + 1) if 0 <= start < length else None


def _plus(call: Call, other: Value) -> Value:
    if not isinstance(other, RubyString):
        name = "nil" if other is None else class_name(other)
        raise RubyError("TypeError", f"no implicit conversion of {name} into String", call.span)
    return RubyString(call.run.joined(_receiver(call), call.traced(other)))


def _append(call: Call, *others: Value) -> Value:
    call.changeable()
    more = [call.traced(other) for other in others]
    own = call.string(call.receiver)
    own.content = call.run.joined(own.content, *more)
    return call.receiver


def _times(call: Call, factor: Value) -> Value:
    count = call.integer(factor)
    if count < 0:
        raise call.refuse("with a negative number")
    content = _receiver(call)
    call.run.budget.spend_text(len(content.text) * count, len(content.pieces) * count)
    return call.run.string(TracedString(content.pieces * (count if content.pieces else 0)))


def _occurrences(call: Call, pattern: str) -> Iterator[tuple[int, int]]:
    """Yield the ranges of a text that do not overlap; an empty one is between characters."""
    text, at = _text(call), 0
    while (start := text.find(pattern, at)) >= 0:
        call.run.budget.spend()
        yield start, start + len(pattern)
        at = start + max(1, len(pattern))
        if at > len(text):
            return


def _gaps(text: str, occurrences: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return the ranges of a text before, between and behind others."""
    starts = [0, *(end for _, end in occurrences)]
    return list(zip(starts, [*(start for start, _ in occurrences), len(text)], strict=True))


def _replaced(call: Call, pattern: Value, replacement: Value, *, every: bool) -> Value:
    content, new = _receiver(call), call.traced(replacement)
    if "\\" in new.text:
        raise call.refuse("with a backslash in the replacement")
    occurrences = list(_occurrences(call, call.text(pattern)))
    occurrences = occurrences if every else occurrences[:1]
    kept = content.cut_many(_gaps(content.text, occurrences))
    call.run.budget.spend_text(len(new.text) * len(occurrences), len(new.pieces) * len(occurrences))
    parts = [kept[0]]
    for part in kept[1:]:
        parts += [new, part]
    return call.run.string(join_strings(parts))


def _gsub(call: Call, pattern: Value, replacement: Value) -> Value:
    return _replaced(call, pattern, replacement, every=True)


def _sub(call: Call, pattern: Value, replacement: Value) -> Value:
    return _replaced(call, pattern, replacement, every=False)


def _split(call: Call, separator: Value = None) -> Value:
    content, text = _receiver(call), _text(call)
    between = call.text(separator) if separator is not None else " "
    if between == "":
        ranges = [(at, at + 1) for at in range(len(text))]
    elif between == " ":
        ranges = [match.span() for match in _WORD.finditer(text)]
    else:
        ranges = _gaps(text, list(_occurrences(call, between)))
    while ranges and ranges[-1][0] == ranges[-1][1]:
        ranges.pop()
    call.run.budget.spend(len(ranges))
    return call.run.array([call.run.string(part) for part in content.cut_many(ranges)])


_WORD = re.compile(rf"[^{_BLANKS}\0]+")


def _changed(change: Callable[[str], str]) -> Method:
    """Make a method that computes new characters, such as `upcase`."""

    def changed(call: Call) -> Value:
        return call.run.computed(change(_text(call)), call.span)

    return changed


def _tested(test: Callable[[str, str], bool]) -> Method:
    def tested(call: Call, *others: Value) -> Value:
        texts = [call.text(other) for other in others]
        return any(test(_text(call), text) for text in texts)

    return tested


def _to_i(call: Call) -> Value:
    """Read the integer that leads the text, else 0."""
    match = _INTEGER.match(_text(call))
    digits = match.group(1).replace("_", "") if match else "0"
    if len(digits) > _MAX_DIGITS:
        raise LimitReached(f"makes an integer of more than {_MAX_DIGITS} digits")
    return int(digits)


def _to_f(call: Call) -> Value:
    """Read the number that leads the text, else 0.0."""
    match = _FLOAT.match(_text(call)[:2000])
    return float(match.group(1).replace("_", "")) if match else 0.0


def _format(call: Call, values: Value) -> Value:
    items = values.items if isinstance(values, RubyArray) else [values]
    return formatted(call, call.receiver, list(items))


STRING: Methods = {
    "+": _plus,
    "*": _times,
    "%": _format,
    "<<": _append,
    "concat": _append,
    "[]": _at,
    "chomp": _chomp,
    "strip": _strip,
    "gsub": _gsub,
    "sub": _sub,
    "split": _split,
    "upcase": _changed(str.upper),
    "downcase": _changed(str.lower),
    "capitalize": _changed(lambda text: text[:1].upper() + text[1:].lower()),
    "start_with?": _tested(str.startswith),
    "end_with?": _tested(str.endswith),
    "include?": _tested(lambda text, part: part in text),
    "length": lambda call: len(_text(call)),
    "size": lambda call: len(_text(call)),
    "empty?": lambda call: not _text(call),
    "to_sym": lambda call: Symbol(_text(call)),
    "to_i": _to_i,
    "to_f": _to_f,
}
