"""What a rule reports when it is selected alone, the full run reports too, or repeats."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from msgspec.structs import replace

from checker.base.cache import Cache, cache_folder
from checker.base.parts import type_name
from checker.engine.judge import Judge
from checker.engine.run import Outcome, run_rules
from checker.engine.subject import Subject
from checker.finding import Place
from checker.package.inputs import open_input
from checker.package.package import Package
from checker.rule import Rule, finding
from checker.rulebook.discovery import all_rules
from checker.rulebook.profiles import profile
from checker.rulebook.suppression.parts import BaselineUse, Suppressions
from checker.settings import Settings
from support.real_packages import MODERN, judged_folders, needed_folder
from tests.conftest import SAMPLES
from tests.engine.stage import at, rule_saying, run

Told = tuple[str, str, int, int, str]
"""A rule and a place that it reports."""
_OF_OTHERS = {type_name(Suppressions), type_name(BaselineUse)}
"""What all other rules found; it is known only after these."""


def told(outcome: Outcome) -> Iterator[Told]:
    """Yield each rule with each place that it reports or whose report is repeated."""
    for found in outcome.findings:
        for rule, places in (
            (found.rule, found.places),
            *((repeat.rule, repeat.places) for repeat in found.repeats),
        ):
            yield from _told(rule, places)


def _told(rule: str, places: Sequence[Place]) -> Iterator[Told]:
    return ((rule, place.file, place.line, place.column, place.element) for place in places)


def differences(package: Package, *, trial: bool) -> list[str]:
    """Return what rules selected alone report of a package and the full run does not."""
    settings = Settings(trial=trial).for_package(package)
    judge = Judge(profile(settings.profile), settings)

    def selecting(rule: Rule) -> Judge:
        return Judge(judge.profile, replace(settings, select=(rule.id,)))

    rules = [
        rule
        for rule in all_rules()
        if judge.profile.includes(rule) and _OF_OTHERS.isdisjoint(rule.needs.values())
    ]
    subject = Subject(package, Cache(cache_folder()))
    try:
        full = set(told(run_rules(rules, subject, judge)))
        alone = {
            each for rule in rules for each in told(run_rules([rule], subject, selecting(rule)))
        }
    finally:
        subject.close()
    return [f"{package.name}: {each}" for each in sorted(full ^ alone)]


def differences_below(folder: Path, *, trial: bool = False) -> list[str]:
    with open_input(folder) as opened:
        assert opened.packages
        return [each for package in opened.packages for each in differences(package, trial=trial)]


def test_a_covered_finding_is_a_repeat_of_the_one_that_is_told() -> None:
    """Also where the rule that covers it is covered itself."""
    said = (("TST001", ("TST002",)), ("TST002", ("TST003",)), ("TST003", ()))
    rules = [
        rule_saying(finding(at(3, "link[a]"), f"{id} says so", covered_by=others), id=id)
        for id, others in said
    ]
    (found,) = run(*rules).findings
    assert found.rule == "TST003"
    assert found.also == ("TST001", "TST002")
    assert [each.message for each in found.repeats] == ["TST001 says so", "TST002 says so"]


@pytest.mark.slow
@pytest.mark.parametrize("sample", sorted(SAMPLES.glob("*/")), ids=lambda path: path.name)
def test_samples(sample: Path) -> None:
    assert not differences_below(sample, trial=True)


@pytest.mark.corpus
def test_submitted_robots(corpus: Path) -> None:
    assert not differences_below(corpus)


@pytest.mark.corpus
def test_packages_of_today() -> None:
    needed_folder(MODERN)
    assert not [each for top in judged_folders(MODERN) for each in differences_below(top)]
