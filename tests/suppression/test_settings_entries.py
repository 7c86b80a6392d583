"""Findings that a settings file sets aside."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.errors import InvalidSettings
from checker.engine.options import check_against_rules
from checker.finding import Place
from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.rulebook.discovery import all_rules
from checker.rulebook.example_files import NAME
from checker.rulebook.suppression.entries import SettingsEntry
from checker.settings import find_settings, parse_settings
from tests.suppression.stage import REASON, axle, checked, checked_again, found, set_aside


def entry(**more: str) -> str:
    said = {"rule": "KIN001", "reason": REASON, **more}
    return "[[suppress]]\n" + "".join(f'{key} = "{value}"\n' for key, value in said.items())


@pytest.mark.parametrize(
    "more",
    [
        {},
        {"rule": "unknown-joint-link"},
        {"rule": "kin001"},
        {"file": "model.sdf"},
        {"file": "*.sdf"},
        {"element": "joint[axle]"},
        {"file": "mod?l.*", "element": "model["},
    ],
)
def test_an_entry_sets_findings_aside(more: dict[str, str], tmp_path: Path) -> None:
    report = checked({"@fragment": axle(), "subt-check.toml": entry(**more)}, tmp_path)
    assert found(report) == []
    assert set_aside(report) == [("KIN001", "settings", REASON)]
    assert report.suppressed[0].place is None
    assert "1 suppressed with reasons" in report.settings


@pytest.mark.parametrize(
    "more", [{"file": "urdf/*"}, {"element": "link["}, {"rule": "KIN002"}, {"file": "."}]
)
def test_an_entry_for_something_else_is_of_no_use(more: dict[str, str], tmp_path: Path) -> None:
    settings = entry(**more)
    report = checked({"@fragment": axle(), "subt-check.toml": settings}, tmp_path, "KIN")
    assert report.suppressed == ()
    (unused,) = (each for each in report.findings if each.rule == "CFG002")
    assert (unused.severity, unused.places[0].file) == ("warning", "subt-check.toml")


def test_an_entry_for_a_rule_that_did_not_look_is_not_judged(tmp_path: Path) -> None:
    settings = entry(rule="SEN005")
    report = checked({"@fragment": axle(), "subt-check.toml": settings}, tmp_path)
    assert [each.rule for each in report.findings] == ["KIN001"]


def test_settings_for_many_packages_need_not_serve_each(tmp_path: Path) -> None:
    (tmp_path / "subt-check.toml").write_text(entry() + entry(element="joint[other]"), "utf-8")
    package = write_example(axle(), tmp_path)
    settings = find_settings([tmp_path])
    assert settings.source == tmp_path / "subt-check.toml"
    chosen = settings.with_overrides(select=("CFG", "KIN001"), trial=False, cache=False)
    (report,) = check_package(package, chosen).packages
    (idle,) = report.findings
    assert (idle.severity, str(idle.places[0])) == ("info", ".:1:1")
    assert "subt-check.toml" in idle.message
    assert "joint[other]" in idle.message
    assert set_aside(report) == [("KIN001", "settings", REASON)]


def test_the_folder_is_a_dot() -> None:
    assert SettingsEntry("PKG001", REASON, ".").covers(Place(""))
    assert not SettingsEntry("PKG001", REASON, ".").covers(Place("model.sdf"))


@pytest.mark.parametrize(
    ("value", "problem"),
    [
        ("SEN005", "not a list"),
        ([{"rule": "SEN005", "reason": REASON}] * 201, "not a list"),
        (["SEN005"], "suppress 1 is not a table"),
        ([{"rule": "SEN005", "reason": "x"}, {"rule": "SEN005"}], "suppress 2 has no reason"),
        ([{"rule": "SEN005", "reason": " "}], "has no reason"),
        ([{"rule": "SEN005", "reason": "x" * 1_001}], "of more than 1000 characters"),
        ([{"rule": "A", "reason": "x", "file": "*" * 1_001}], "has file of more than 1000"),
        ([{"rule": "A", "reason": "x", "element": "e" * 1_001}], "has element of more than 1000"),
        ([{"reason": "x"}], "has no rule"),
        ([{"rule": "SEN005", "reason": 7}], "reason = 7, expected a string"),
        ([{"rule": "SEN005", "reason": "x", "line": "7"}], "has 'line', expected rule, file"),
    ],
)
def test_entries_of_another_form_are_refused(value: object, problem: str, tmp_path: Path) -> None:
    with pytest.raises(InvalidSettings, match=problem):
        parse_settings({"suppress": value}, tmp_path / "subt-check.toml")


@pytest.mark.parametrize(
    ("rule", "problem"),
    [
        ("SEN999", r"there is no rule 'SEN999'"),
        (
            "unknown-joint-links",
            r"no rule 'unknown-joint-links'; did you mean unknown-joint-link\?",
        ),
        ("KIM", r"there is no rule 'KIM'; `subt-check rules` lists them"),
        ("KIN", r"suppress names the group 'KIN'; expected a single rule"),
        ("kin", r"suppress names the group 'kin'; expected a single rule"),
    ],
)
def test_an_entry_for_no_single_rule_is_refused(rule: str, problem: str, tmp_path: Path) -> None:
    content = {"suppress": [{"rule": rule, "reason": REASON}]}
    settings = parse_settings(content, tmp_path / "subt-check.toml")
    with pytest.raises(InvalidSettings, match=problem):
        check_against_rules(settings, all_rules())


def test_a_comment_counts_before_settings(tmp_path: Path) -> None:
    child = "<child>tyre</child> <!-- subt-check: ignore[KIN001] by comment -->"
    package = write_example({"@fragment": axle(child), "subt-check.toml": entry()}, tmp_path)
    report = checked_again(package)
    assert package.name == NAME
    assert (found(report), set_aside(report)) == ([], [("KIN001", "comment", "by comment")])
