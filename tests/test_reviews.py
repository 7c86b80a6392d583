"""Faults that maintainers had corrected: reported before the correction, gone after it."""

from __future__ import annotations

import pytest

from tests.real_packages import REVIEWS, needs
from tests.review_cases import OUT_OF_REACH, ReviewCase, review_cases

CASES = [case for case in review_cases() if case.id not in OUT_OF_REACH]


@needs(REVIEWS)
def test_there_are_cases() -> None:
    assert len(CASES) >= 48


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.id}-{case.rules[0]}")
def test_fault_is_reported_until_it_is_corrected(case: ReviewCase) -> None:
    assert case.corrected()
