"""Every rule finds its fault in each bad example, at the marked line, and none in a good one."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from checker.base.cache import Cache, cache_folder
from checker.engine.review import run_and_set_aside
from checker.engine.subject import Subject
from checker.package.inputs import open_input
from checker.report.report import Cause
from checker.rule import Rule
from checker.rulebook.discovery import all_rules
from checker.settings import find_settings
from tests.each import of_each
from tests.examples import expected_places, judge_of, write_example

CASES = [
    pytest.param(rule, kind, example, id=f"{rule.id}-{kind}-{number}")
    for rule in all_rules()
    for kind in ("good", "bad")
    for number, example in enumerate(getattr(rule, kind), 1)
]


@pytest.mark.parametrize(("rule", "kind", "example"), CASES)
def test_example(rule: Rule, kind: str, example: Any, tmp_path: Path) -> None:
    package = write_example(example, tmp_path)
    with open_input(package) as opened:
        subject = Subject(opened.packages[0], Cache(cache_folder()))
        settings = find_settings([package]).overridden(thorough=True)
        outcome = run_and_set_aside(
            [rule, *_companions(example)], subject, judge_of(rule), settings
        )
    unseen = [each for each in outcome.not_checked if each.rule == rule.id]
    looked_away = [each for each in unseen if each.cause is not Cause.NOT_APPLICABLE]
    assert not looked_away
    reported = {
        f"{place.file or '.'}:{place.line}"
        for finding in outcome.findings
        if finding.rule == rule.id
        for place in finding.places
        if not place.note
    }
    expected = expected_places(example, rule.id, package)
    assert reported == expected
    assert bool(expected) is (kind == "bad")


def _companions(example: Any) -> list[Rule]:
    """Return the rules that run along."""
    names = example.get("@with", ()) if isinstance(example, Mapping) else ()
    return [rule for rule in all_rules() if rule.id in names]


@of_each("rule", all_rules(), ids=lambda rule: rule.id)
def test_every_rule_has_examples_of_both_kinds(rule: Rule) -> None:
    assert rule.good
    assert rule.bad
