"""Every rule finds its fault in each bad example, at the marked line, and none in a good one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from checker.cache import Cache, cache_folder
from checker.discovery import all_rules
from checker.engine import run_rules
from checker.package.opening import open_input
from checker.profiles import profile
from checker.report.report import Cause
from checker.rule import Rule
from checker.settings import Settings
from checker.subject import Subject
from tests.examples import expected_places, write_example

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
        judge = profile("subt") if profile("subt").includes(rule) else profile("urdf")
        outcome = run_rules([rule], subject, judge, Settings(thorough=True))
    looked_away = [n for n in outcome.not_checked if n.cause is not Cause.NOT_APPLICABLE]
    assert not looked_away
    reported = {
        f"{place.file or '.'}:{place.line}"
        for finding in outcome.findings
        for place in finding.places
        if not place.note
    }
    expected = expected_places(example, rule.id, package)
    assert reported == expected
    assert bool(expected) is (kind == "bad")


@pytest.mark.parametrize("rule", all_rules(), ids=lambda rule: rule.id)
def test_every_rule_has_examples_of_both_kinds(rule: Rule) -> None:
    assert rule.good
    assert rule.bad
