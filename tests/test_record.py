"""Dataclasses that are made by the thousand: values by value, places by identity."""

from __future__ import annotations

import pytest

from checker.model.geometry.transform import Transform
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
