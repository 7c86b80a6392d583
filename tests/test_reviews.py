"""Faults that maintainers had corrected: reported before the correction, gone after it."""

from __future__ import annotations

import pytest

from support.real_packages import REVIEWS, needs
from support.review_cases import OUT_OF_REACH, ReviewCase, review_cases

pytestmark = needs(REVIEWS)
CASES = [case for case in review_cases() if case.id not in OUT_OF_REACH]


def test_there_are_cases() -> None:
    assert len(CASES) >= 48


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.id}-{case.rules[0]}")
def test_fault_is_reported_until_it_is_corrected(case: ReviewCase) -> None:
    assert case.corrected()
