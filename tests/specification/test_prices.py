"""Prices of a sheet."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.specification.mass_cost_endurance import Price, prices
from checker.source.text import SourceText, Span


def read(text: str) -> tuple[Price, ...]:
    source = SourceText("specifications.md", text)
    return prices(Span(source, 0, len(text)))


@pytest.mark.parametrize(
    ("line", "amount"),
    [
        ("$200 - D435i", 200),
        ("* Base vehicle: $12,000 (only 5 pieces)", 12000),
        ("* Sensors: USD 8,100 ($7,000 for one)", 8100),
        ("| body | EUR 2,000.50 |", 2000.5),
        ("- frame: about 300 USD", 300),
    ],
)
def test_a_part_is_a_price_and_what_it_is_for(line: str, amount: float):
    (price,) = read(line)
    assert (price.amount, price.is_part, price.is_sum) == (amount, True, False)


@pytest.mark.parametrize(
    "line",
    ["* Total: ~ $22,600", "An estimated cost of USD 935.", "| total | USD 10,000 |"],
)
def test_a_sum_is_no_part(line: str):
    (price,) = read(line)
    assert price.is_sum
    assert not price.is_part


def test_prose_is_neither():
    (price,) = read("The frame was bought for $1200 some years ago.")
    assert not price.is_sum
    assert not price.is_part


@pytest.mark.parametrize(
    "line", ["$100-200 - frame", "$20 each - wheel", "* rent: $1500 per month"]
)
def test_ranges_and_prices_a_piece_are_not_clear(line: str):
    (price,) = read(line)
    assert not price.is_clear


@given(st.text(alphabet="$0123456789,.' |:-*USDtoal\n", max_size=200))
def test_any_text_is_read_and_places_lie_in_it(text: str):
    for price in read(text):
        assert 0 <= price.span.start < price.span.end <= len(text)
        assert price.amount >= 0
