"""Methods of String; parts of a string keep their origin."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from checker.expand.spawner.methods.array import slice_bounds
from checker.expand.spawner.methods.call import Call, Methods
from checker.expand.spawner.methods.conversion import leading_float, leading_integer
from checker.expand.spawner.methods.format import formatted
from checker.expand.spawner.signals import RubyError
from checker.expand.spawner.traced import TracedString, joined
from checker.expand.spawner.values import (
    NIL,
    RubyArray,
    RubyRange,
    RubyString,
    Symbol,
    Value,
    class_name,
)

_BLANKS = "\t\n\v\f\r "


def _own(call: Call) -> TracedString:
    return call.traced(call.receiver)


def _text(call: Call) -> str:
    return call.text(call.receiver)


def _cut(call: Call, start: int, end: int) -> Value:
    return call.run.string(_own(call).cut(start, end))


def _chomp(call: Call, suffix: Value | None = None) -> Value:
    text = _text(call)
    if suffix is not None:
        ending = call.text(suffix)
        return _cut(call, 0, len(text) - len(ending) if text.endswith(ending) else len(text))
    for ending in ("\r\n", "\n", "\r"):
        if text.endswith(ending):
            return _cut(call, 0, len(text) - len(ending))
    return _cut(call, 0, len(text))


def _strip(call: Call) -> Value:
    text = _text(call)
    return _cut(call, len(text) - len(text.lstrip(_BLANKS)), len(text.rstrip(_BLANKS + "\0")))


def _lstrip(call: Call) -> Value:
    text = _text(call)
    return _cut(call, len(text) - len(text.lstrip(_BLANKS)), len(text))


def _rstrip(call: Call) -> Value:
    return _cut(call, 0, len(_text(call).rstrip(_BLANKS + "\0")))


def _slice(call: Call, index: Value, count: Value | None = None) -> Value:
    text = _text(call)
    if isinstance(index.data, RubyString) and count is None:
        at = text.find(index.data.text)
        return NIL if at < 0 else _cut(call, at, at + len(index.data.text))
    if count is None and not isinstance(index.data, RubyRange):
        start = call.integer(index)
        start += len(text) if start < 0 else 0
        return _cut(call, start, start + 1) if 0 <= start < len(text) else NIL
    bounds = slice_bounds(call, len(text), index, count)
    return NIL if bounds is None else _cut(call, *bounds)


def _plus(call: Call, other: Value) -> Value:
    if not isinstance(other.data, RubyString):
        name = "nil" if other.data is None else class_name(other.data)
        raise RubyError("TypeError", f"no implicit conversion of {name} into String", call.span)
    return Value(RubyString(call.run.joined(_own(call), call.traced(other))))


def _append(call: Call, *others: Value) -> Value:
    call.changeable()
    more = [call.traced(other) for other in others]
    own = call.string(call.receiver)
    own.content = call.run.joined(own.content, *more)
    return call.receiver


def _prepend(call: Call, other: Value) -> Value:
    call.changeable()
    own = call.string(call.receiver)
    own.content = call.run.joined(call.traced(other), own.content)
    return call.receiver


def _times(call: Call, factor: Value) -> Value:
    count = call.integer(factor)
    if count < 0:
        raise call.refuse("with a negative number")
    content = _own(call)
    call.run.budget.spend_text(len(content.text) * count, len(content.pieces) * count)
    return call.run.string(TracedString(content.pieces * (count if content.pieces else 0)))


def _occurrences(call: Call, wanted: str) -> Iterator[tuple[int, int]]:
    """Yield the ranges of a text that do not overlap; an empty one stands between characters."""
    text, at = _text(call), 0
    while (found := text.find(wanted, at)) >= 0:
        call.run.budget.spend()
        yield found, found + len(wanted)
        at = found + max(1, len(wanted))
        if at > len(text):
            return


def _replace(call: Call, wanted: Value, replacement: Value, *, every: bool) -> Value:
    content, new = _own(call), call.traced(replacement)
    if "\\" in new.text:
        raise call.refuse("with a backslash in the replacement")
    found = list(_occurrences(call, call.text(wanted)))
    found = found if every else found[:1]
    starts = [0, *(end for _, end in found)]
    ends = [*(start for start, _ in found), len(content.text)]
    kept = content.cut_many(zip(starts, ends, strict=True))
    call.run.budget.spend_text(len(new.text) * len(found), len(new.pieces) * len(found))
    parts = [kept[0]]
    for part in kept[1:]:
        parts += [new, part]
    return call.run.string(joined(parts).influenced(wanted.influences))


def _gsub(call: Call, wanted: Value, replacement: Value) -> Value:
    return _replace(call, wanted, replacement, every=True)


def _sub(call: Call, wanted: Value, replacement: Value) -> Value:
    return _replace(call, wanted, replacement, every=False)


def _split(call: Call, separator: Value | None = None) -> Value:
    content, text = _own(call), _text(call)
    between = call.text(separator) if separator is not None else " "
    if between == "":
        ranges = [(at, at + 1) for at in range(len(text))]
    elif between == " ":
        ranges = _words(text)
    else:
        found = list(_occurrences(call, between))
        starts = [0, *(end for _, end in found)]
        ranges = list(zip(starts, [*(start for start, _ in found), len(text)], strict=True))
    while ranges and ranges[-1][0] == ranges[-1][1]:
        ranges.pop()
    call.run.budget.spend(len(ranges))
    return call.run.array([call.run.string(part) for part in content.cut_many(ranges)])


def _words(text: str) -> list[tuple[int, int]]:
    ranges, start = [], -1
    for at, char in enumerate([*text, " "]):
        if char in _BLANKS or char == "\0":
            if start >= 0:
                ranges.append((start, at))
            start = -1
        elif start < 0:
            start = at
    return ranges


def _lines(call: Call) -> Value:
    content, ranges, at = _own(call), [], 0
    for line in content.text.split("\n"):
        end = min(at + len(line) + 1, len(content.text))
        if end > at:
            ranges.append((at, end))
        at = end
    call.run.budget.spend(len(ranges))
    return call.run.array([call.run.string(part) for part in content.cut_many(ranges)])


def _each_line(call: Call) -> Value:
    lines = _lines(call)
    for line in call.array(lines).items:
        call.each(line)
    return call.receiver


def _changed(change: Callable[[str], str]) -> Callable[[Call], Value]:
    """Make a method that computes new characters, such as `upcase`."""

    def method(call: Call) -> Value:
        return call.run.computed(change(_text(call)), call.span, call.receiver)

    return method


def _pad(adjust: Callable[[str, int, str], str]) -> Callable[..., Value]:
    def method(call: Call, width: Value, filler: Value | None = None) -> Value:
        fill = call.text(filler) if filler else " "
        if len(fill) != 1:
            raise call.refuse("with a filler of several characters")
        length = max(0, call.integer(width))
        call.run.budget.spend_text(length)
        text = adjust(_text(call), length, fill)
        return call.run.computed(text, call.span, call.receiver)

    return method


def _center(text: str, width: int, fill: str) -> str:
    missing = max(0, width - len(text))
    return fill * (missing // 2) + text + fill * (missing - missing // 2)


def _test(test: Callable[[str, str], bool]) -> Callable[..., Value]:
    def method(call: Call, *others: Value) -> Value:
        texts = [call.text(other) for other in others]
        return call.value(any(test(_text(call), text) for text in texts), *others)

    return method


def _index(call: Call, wanted: Value) -> Value:
    at = _text(call).find(call.text(wanted))
    return call.value(at if at >= 0 else None, wanted)


def _to_sym(call: Call) -> Value:
    return call.run.value(Symbol(_text(call)), call.receiver)


def _format(call: Call, values: Value) -> Value:
    items = values.data.items if isinstance(values.data, RubyArray) else [values]
    return formatted(call, call.receiver, list(items))


def _in_place(method: Callable[..., Value]) -> Callable[..., Value]:
    """Make `gsub!` of `gsub`: it changes the receiver, and answers nil when nothing changed."""

    def changed(call: Call, wanted: Value, replacement: Value) -> Value:
        call.changeable()
        result = method(call, wanted, replacement)
        own, new = call.string(call.receiver), call.string(result)
        same = own.text == new.text
        own.content = new.content
        return NIL if same else call.receiver

    return changed


STRING: Methods = {
    "+": _plus,
    "*": _times,
    "%": _format,
    "<<": _append,
    "concat": _append,
    "prepend": _prepend,
    "[]": _slice,
    "slice": _slice,
    "chomp": _chomp,
    "chop": lambda call: _cut(call, 0, len(_text(call)) - 1),
    "strip": _strip,
    "lstrip": _lstrip,
    "rstrip": _rstrip,
    "gsub": _gsub,
    "sub": _sub,
    "gsub!": _in_place(_gsub),
    "sub!": _in_place(_sub),
    "split": _split,
    "lines": _lines,
    "upcase": _changed(str.upper),
    "downcase": _changed(str.lower),
    "capitalize": _changed(lambda text: text[:1].upper() + text[1:].lower()),
    "reverse": _changed(lambda text: text[::-1]),
    "ljust": _pad(str.ljust),
    "rjust": _pad(str.rjust),
    "center": _pad(_center),
    "start_with?": _test(str.startswith),
    "end_with?": _test(str.endswith),
    "include?": _test(lambda text, part: part in text),
    "index": _index,
    "length": lambda call: call.value(len(_text(call))),
    "size": lambda call: call.value(len(_text(call))),
    "empty?": lambda call: call.value(not _text(call)),
    "to_str": lambda call: call.receiver,
    "to_sym": _to_sym,
    "to_i": lambda call: call.value(leading_integer(_text(call))),
    "to_f": lambda call: call.value(leading_float(_text(call))),
    "+@": lambda call: call.receiver,
}

STRING_WITH_BLOCK: Methods = {"each_line": _each_line}
