"""The rules are those of the rule book, no more and no fewer."""

from __future__ import annotations

import pytest

from checker.cli import main
from checker.rulebook.discovery import all_rules

BOOK = {
    "CFG": 4,
    "PKG": 21,
    "SDF": 19,
    "REF": 6,
    "KIN": 20,
    "INE": 14,
    "GEO": 17,
    "MSH": 10,
    "SEN": 29,
    "PLG": 12,
    "SPW": 14,
    "DRV": 13,
    "BAT": 5,
    "BRD": 3,
    "ROS": 15,
    "DOC": 9,
    "URD": 30,
    "CTL": 8,
    "BRG": 11,
    "WIR": 8,
    "LCH": 18,
    "WLD": 11,
    "R2C": 14,
    "TRI": 18,
}
"""The groups of the book, and the number of the last rule of each; none is left out."""


def test_every_rule_of_the_book_exists_and_no_other() -> None:
    book = {f"{group}{number:03}" for group, last in BOOK.items() for number in range(1, last + 1)}
    ours = {rule.id for rule in all_rules() if rule.check.__module__.startswith("rules.")}
    assert ours == book


def test_they_are_listed_group_by_group(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rules"]) == 0
    listed = [line.split()[0] for line in capsys.readouterr().out.splitlines()]
    groups = list(dict.fromkeys(id.rstrip("0123456789") for id in listed))
    assert sorted(groups) == sorted(BOOK)
    assert listed == sorted(listed)
