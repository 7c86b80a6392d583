"""Rules are named as their files are, and found by the names that they had before."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.resources import table
from checker.cli import main
from checker.rulebook.discovery import all_rules
from checker.settings import Settings
from tests.suppression.stage import TYRE, axle, checked, ignore

RULES = {rule.id: rule for rule in all_rules() if rule.check.__module__.startswith("rules.")}
FORMER = table("former_rule_names")["names"]


def test_a_file_has_the_id_and_the_name_of_its_rule() -> None:
    for rule in RULES.values():
        module = rule.check.__module__.rpartition(".")[2]
        assert module == f"{rule.id.lower()}_{rule.name.replace('-', '_')}"


def test_a_name_is_that_of_one_rule() -> None:
    names = [name for rule in RULES.values() for name in rule.names]
    assert FORMER.keys() <= RULES.keys()
    assert len(names) == len(set(names)) == 2 * len(RULES) + sum(map(len, FORMER.values()))


@pytest.mark.parametrize("name", ["link-tied-to-nothing", "KIN003", "Disconnected-Link"])
def test_the_page_is_found_by_a_former_name(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rule", name]) == 0
    assert capsys.readouterr().out.startswith("KIN003 disconnected-link ")


def test_a_former_name_selects_the_rule() -> None:
    settings = Settings(select=("link-tied-to-nothing",))
    assert [id for id, rule in RULES.items() if settings.selects(rule)] == ["KIN003"]
    assert settings.names(RULES["KIN003"])


def test_a_former_name_suppresses_the_finding(tmp_path: Path) -> None:
    comment = f"{ignore('unknown-joint-end')}\n{TYRE}"
    report = checked(axle(comment), tmp_path)
    assert not report.findings
    assert [each.finding.rule for each in report.suppressed] == ["KIN001"]
