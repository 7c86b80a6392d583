"""The ids of rules: those of each group are numbered without a gap, and listed in order."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping

import pytest

from checker.cli import main
from checker.rulebook.discovery import all_rules
from checker.rulebook.profiles import profile


def test_the_ids_of_each_group_are_numbered_from_001_without_a_gap() -> None:
    numbers = defaultdict(list)
    for rule in all_rules():
        if rule.check.__module__.startswith("rules."):
            numbers[rule.group].append(int(rule.id.removeprefix(rule.group)))
    assert numbers == {group: [*range(1, len(ids) + 1)] for group, ids in numbers.items()}


def test_they_are_listed_group_by_group(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rules"]) == 0
    listed = [line.split()[0] for line in capsys.readouterr().out.splitlines()]
    assert listed == sorted(rule.id for rule in all_rules())


def test_rules_with_examples_of_ros_2_run_on_packages_of_ros_2() -> None:
    """A profile that lists single rules of a group forgets the next one."""
    profiles = [profile("ros2"), profile("ros2-classic")]
    about = [
        rule
        for rule in all_rules()
        if any("@ros2" in it for it in (*rule.good, *rule.bad) if isinstance(it, Mapping))
    ]
    assert not [rule.id for rule in about if not any(each.includes(rule) for each in profiles)]
