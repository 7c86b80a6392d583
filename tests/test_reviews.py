"""Faults that maintainers had corrected: reported before the correction, gone after it.

The packages are reached through SUBT_CHECK_REVIEWS: `<id>/before/<package>`, `<id>/after/<package>`
and `cases.json`, which names the file and the rules of which any may report the fault.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest

from checker.check import check_package
from checker.discovery import all_rules
from checker.settings import Settings

FOLDER = Path(os.environ.get("SUBT_CHECK_REVIEWS") or "no reviews")
KNOWN = frozenset(rule.id for rule in all_rules())


def cases() -> list[dict[str, Any]]:
    """Return the cases that a rule of ours may report."""
    if not FOLDER.is_dir():
        return []
    found = json.loads((FOLDER / "cases.json").read_text("utf-8"))
    return [case for case in found if KNOWN.intersection(case["rules"])]


def said(case: dict[str, Any], side: str) -> set[tuple[str, str, str]]:
    """Return rule, message and element of what the named rules report in the named file."""
    (package,) = check_package(FOLDER / case["id"] / side / case["package"], Settings()).packages
    return {
        (finding.rule, finding.message, place.element)
        for finding in package.findings
        if finding.rule in case["rules"]
        for place in finding.places
        if place.file == case["file"]
    }


@pytest.mark.skipif(not FOLDER.is_dir(), reason="SUBT_CHECK_REVIEWS names no folder of reviews")
def test_there_are_cases() -> None:
    assert cases()


@pytest.mark.parametrize("case", cases(), ids=lambda case: f"{case['id']}-{case['rules'][0]}")
def test_fault_is_reported_until_it_is_corrected(case: dict[str, Any]) -> None:
    assert said(case, "before") - said(case, "after")
