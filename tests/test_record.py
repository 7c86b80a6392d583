"""Records: values by value, places by identity, and a text that fits on a line."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

from checker.base.record import Record
from checker.engine.subject import Subject
from checker.model.geometry.transform import Transform
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.source.text import Located, SourceText, Span


def test_values_are_compared_and_hashed_by_their_fields() -> None:
    span = SourceText("a.sdf", "<a/>").whole()
    assert Located(1.0, span) == Located(1.0, span)
    assert Located(1.0, span) != Located(1.0, span, stated=False)
    assert len({Located(1.0, span), Located(1.0, span)}) == 1
    assert len({Transform(), Transform()}) == 1


def test_places_are_compared_by_identity() -> None:
    source = SourceText("a.sdf", "<a/>")
    assert Span(source, 0, 1) != Span(source, 0, 1)


def test_a_place_has_no_room_for_more() -> None:
    span = SourceText("a.sdf", "<a/>").whole()
    with pytest.raises(AttributeError):
        setattr(span, "colour", "red")  # noqa: B010 - a type checker would refuse it


def records(value: Any, seen: set[int]) -> Iterator[Record]:
    """Yield all records that a value holds, however deep."""
    waiting = [value]
    while waiting:
        part = waiting.pop()
        if isinstance(part, str | bytes | int | float | None | type) or id(part) in seen:
            continue
        seen.add(id(part))
        if isinstance(part, Record):
            yield part
            waiting += [getattr(part, name) for name in part.__struct_fields__]
        elif isinstance(part, Mapping):
            waiting += [*part.keys(), *part.values()]
        elif isinstance(part, Iterable):
            waiting += list(part)


@pytest.mark.corpus
def test_what_a_model_shows_of_itself_fits_on_a_line(corpus: Path) -> None:
    with open_input(corpus) as opened:
        for package in opened.packages:
            robots = Subject(package).all(Robot)
            assert isinstance(robots, tuple)
            shown = [repr(record) for record in records(robots, set())]
            assert len(shown) > 1000
            assert max(map(len, shown)) < 1000
            assert not [text for text in shown if "\n" in text]
