"""Whether texts read as the types of the schema."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.formats.sdf.document import (
    QUATERNION_POSE,
    Misread,
    misread_values,
    values_out_of_bounds,
)
from checker.source.text import Located, SourceText, Span

NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
COUNTS = {"vector2d": 2, "vector3": 3, "pose": 6, QUATERNION_POSE: 7}


def located(text: str) -> Located[str]:
    return Located(text, Span(SourceText("model.sdf", text), 0, len(text)))


def faults(text: str, value_type: str) -> list[Misread]:
    return misread_values(located(text), value_type)


@given(NUMBERS)
def test_every_number_that_python_writes_is_a_double(number: float) -> None:
    assert not faults(repr(number), "double")


@given(st.sampled_from(sorted(COUNTS)), st.lists(NUMBERS, min_size=1, max_size=9))
def test_a_vector_reads_when_it_has_its_count(value_type: str, numbers: list[float]) -> None:
    text = " ".join(map(repr, numbers))
    assert bool(faults(text, value_type)) is (len(numbers) != COUNTS[value_type])


@given(st.integers(-(2**40), 2**40))
def test_integers_have_32_bits(number: int) -> None:
    assert bool(faults(str(number), "int")) is not (-(2**31) <= number < 2**31)
    assert bool(faults(str(number), "unsigned int")) is not (0 <= number < 2**32)
    assert bool(faults(hex(number), "unsigned int")) is not (0 <= number < 2**32)


@given(st.text(min_size=1).filter(lambda text: text.strip() == text))
def test_any_text_can_be_judged(text: str) -> None:
    for value_type in ("bool", "int", "double", "color", "pose", "time", "vector3"):
        for fault in faults(text, value_type):
            assert 0 <= fault.span.start <= fault.span.end <= len(text)
    assert not faults(text, "string")


@pytest.mark.parametrize(
    ("value_type", "text"),
    [
        ("bool", "True"),
        ("bool", "0"),
        ("int", "0xFF"),
        ("double", "-inf"),
        ("double", ".5"),
        ("color", "1 0 0"),
        ("color", "1 0 0 0.5"),
        ("time", "12 500000000"),
    ],
)
def test_forms_that_read(value_type: str, text: str) -> None:
    assert not faults(text, value_type)


@pytest.mark.parametrize(
    ("value_type", "text", "word"),
    [
        ("bool", "yes", "yes"),
        ("int", "1e3", "1e3"),
        ("double", "1.O1e2", "1.O1e2"),
        ("double", "nan", "nan"),
        ("double", "3.6 kg", "kg"),
        ("color", "1 0", "1 0"),
        ("pose", "0 0 0 0 0 inf", "inf"),
        ("vector3", "1, 0, 2", "1, 0, 2"),
        ("vector3", "1 0 x", "x"),
        ("time", "12.5", "12.5"),
    ],
)
def test_the_word_at_fault_is_named(value_type: str, text: str, word: str) -> None:
    assert faults(text, value_type)[0].span.text == word


def test_a_whole_number_with_a_point_is_only_lossy() -> None:
    assert [fault.lossy for fault in faults("640.0", "int")] == [True]
    assert [fault.lossy for fault in faults("640.5", "int")] == [False]


@given(NUMBERS, NUMBERS, NUMBERS)
def test_bounds(number: float, low: float, high: float) -> None:
    outside = not low <= number <= high
    assert bool(values_out_of_bounds(located(repr(number)), (low, high))) is outside
    assert not values_out_of_bounds(located(repr(number)), (-math.inf, math.inf))


@pytest.mark.slow
def test_a_long_value_of_nonsense_is_reported_in_brief() -> None:
    assert len(faults("x " * 100_000, "pose")) <= 4


@pytest.mark.parametrize(
    ("value_type", "text", "lossy"),
    [("double", "3.6 kg", True), ("vector3", "1 0 0 0", True), ("vector3", "1 0 x 0", False)],
)
def test_words_after_enough_numbers_are_only_lossy(value_type: str, text: str, lossy: bool) -> None:
    assert {fault.lossy for fault in faults(text, value_type)} == {lossy}
