"""Findings that comments set aside, in every language of a package."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from checker.rule import Rule
from checker.rule_testing import profile_of, write_example
from checker.rulebook.discovery import all_rules
from checker.rulebook.example_files import MINIMAL, NAME, SPAWNER, model_with
from tests.suppression.stage import (
    REASON,
    TYRE,
    axle,
    checked,
    checked_again,
    found,
    ignore,
    set_aside,
)

ASIDE = [("KIN001", "comment", REASON)]


@pytest.mark.parametrize(
    "child",
    [
        f"{TYRE} {ignore('KIN001')}",
        f"{ignore('KIN001')}\n{TYRE}",
        f"{ignore('kin001')} {TYRE}",
        f"{ignore('unknown-joint-link')}\n{TYRE}",
        f"{ignore('SEN005', 'KIN001')}\n{TYRE}",
        f"{ignore('KIN001')}\n{ignore('SEN005')}\n{TYRE}",
        f"{ignore('SEN005')}\n{ignore('KIN001')}\n{TYRE}",
        f"<!-- subt-check: ignore[KIN001]\n  {REASON} -->\n{TYRE}",
    ],
)
def test_a_comment_sets_a_finding_aside(child: str, tmp_path: Path) -> None:
    report = checked(axle(child), tmp_path)
    assert found(report) == []
    assert set_aside(report) == ASIDE


def test_it_stays_visible_with_the_place_of_the_comment(tmp_path: Path) -> None:
    (aside,) = checked(axle(f"{ignore('KIN001')}\n{TYRE}"), tmp_path).suppressed
    assert aside.place is not None
    assert aside.place.file == aside.finding.places[0].file == "model.sdf"
    assert aside.place.line == aside.finding.places[0].line - 1
    assert aside.finding.message.startswith("joint 'axle' has child 'tyre'")


@pytest.mark.parametrize(
    ("child", "rules"),
    [
        (f"{ignore('KIN002')}\n{TYRE}", ["KIN001"]),  # KIN002 did not look
        (f"{ignore('KIN01')}\n{TYRE}", ["CFG003", "KIN001"]),
        (f"{ignore('KIN001', reason='')}\n{TYRE}", ["CFG001", "KIN001"]),
        (f"{ignore('KIN001')}\n\n{TYRE}", ["CFG002", "KIN001"]),
        (f"{TYRE}\n{ignore('KIN001')}", ["CFG002", "KIN001"]),
        (f"{ignore('KIN001')} <!-- \n -->\n{TYRE}", ["CFG002", "KIN001"]),
    ],
)
def test_what_sets_nothing_aside(child: str, rules: list[str], tmp_path: Path) -> None:
    report = checked(axle(child), tmp_path)
    assert sorted(each.rule for each in report.findings) == rules
    assert report.suppressed == ()


def test_unknown_names_are_one_finding_in_many_places(tmp_path: Path) -> None:
    marks = "\n".join(ignore(*(f"NO{n}" for n in range(at, at + 9))) for at in range(0, 900, 9))
    (unknown,) = (
        each for each in checked(axle(f"{marks}\n<child>base_link</child>"), tmp_path).findings
    )
    assert unknown.rule == "CFG003"
    assert len(unknown.places) == 100
    assert unknown.message.startswith("there is no rule 'NO0', nor 'NO1', nor 'NO2'")
    assert unknown.message.endswith(" and 895 more")


def test_a_mark_without_its_colon_is_said(tmp_path: Path) -> None:
    mark = ignore("KIN001").replace("check:", "check")
    report = checked(axle(f"{mark}\n{TYRE}"), tmp_path)
    assert {each.rule for each in report.findings} == {"CFG003", "KIN001"}
    (fault,) = (each for each in report.findings if each.rule == "CFG003")
    expected = "a colon is missing after subt-check, expected 'subt-check: ignore[RULE] reason'"
    assert fault.message == f"the comment has no effect: {expected}"


def test_a_rule_in_use_and_one_that_is_not(tmp_path: Path) -> None:
    report = checked(axle(f"{ignore('KIN001', 'KIN002')}\n{TYRE}"), tmp_path, "KIN001", "KIN002")
    assert set_aside(report) == ASIDE
    (unused,) = report.findings
    assert unused.message == "ignore[KIN002] is unused: KIN002 has no finding on its line"


def test_two_comments_for_one_finding_are_both_of_use(tmp_path: Path) -> None:
    report = checked(axle(f"{ignore('KIN001')}\n{TYRE} {ignore('KIN001')}"), tmp_path)
    assert (found(report), set_aside(report)) == ([], ASIDE)


def test_of_repeats_those_that_are_marked_are_taken_out(tmp_path: Path) -> None:
    """GEO001 joins angles of one value; message, places and fix are those of what is left."""
    turned = "<visual name='{}'><pose>0 0 0 1.57 0 0</pose>{}<geometry><box/></geometry></visual>"
    marked = turned.format("a", ignore("GEO001"))
    fragment = "\n".join([marked, turned.format("b", ""), turned.format("c", "")])
    package = write_example(fragment, tmp_path)
    report = checked_again(package, "GEO001")
    (aside,), (left,) = report.suppressed, report.findings
    assert len(aside.finding.places) == 1
    assert [place.line for place in left.places] == [6, 7]
    assert left.fix is not None
    assert {edit.place.line for edit in left.fix.edits} <= {6, 7}
    model = (package / "model.sdf").read_text("utf-8")
    every = re.sub("(?<=</pose>)(?=<geo)", ignore("GEO001"), model)
    (package / "model.sdf").write_text(every, "utf-8")
    assert found(checked_again(package, "GEO001")) == []


def test_in_what_the_spawner_emits(tmp_path: Path) -> None:
    """In the text that Ruby puts together, only the form of XML is a comment."""
    pose = re.search(r"<pose>.*</pose>", SPAWNER)
    assert pose is not None
    wrong = f"<pose>0 0 0 0 0 0</pose> {ignore('SPW005')}"
    spawner = SPAWNER.replace(pose.group(), wrong)
    report = checked({"launch/spawner.rb": spawner}, tmp_path, "SPW005")
    assert found(report) == []
    assert {rule for rule, _, _ in set_aside(report)} == {"SPW005"}


def test_in_ruby(tmp_path: Path) -> None:
    spawner = f"# subt-check: ignore[SPW003] {REASON}\n" + SPAWNER.replace("rosExecutables", "ros")
    report = checked({"launch/spawner.rb": spawner}, tmp_path, "SPW003")
    assert found(report) == []
    assert set_aside(report) == [("SPW003", "comment", REASON)]


def test_in_a_siblings_file(tmp_path: Path) -> None:
    """The comment counts for all who use the file; that it is of no use is said to its owner."""
    name, other = NAME, NAME.replace("_1", "_2")
    unused = axle("<child>base_link</child> " + ignore("KIN001"), "other")
    write_example(axle(f"{TYRE} {ignore('KIN001')}") + unused, tmp_path)
    manifest = MINIMAL["package.xml"].replace(name, other)
    manifest = manifest.replace("</package>", f"<exec_depend>{name}</exec_depend></package>")
    papers: dict[str, Any] = {"model.sdf": None, "model.config": None, "package.xml": manifest}
    report = checked({"@name": other, **papers}, tmp_path)
    assert set_aside(report) == ASIDE
    assert report.suppressed[0].finding.places[0].file == f"../{name}/model.sdf"
    assert found(report) == []
    assert [each.rule for each in checked_again(tmp_path / name).findings] == ["CFG002"]


def test_in_utf_16(tmp_path: Path) -> None:
    model = model_with(axle(f"{ignore('KIN001')}\n{TYRE}")).replace(
        '"1.0"', '"1.0" encoding="utf-16"'
    )
    report = checked({"model.sdf": model.encode("utf-16")}, tmp_path)
    assert (found(report), set_aside(report)) == ([], ASIDE)
    unused = model.replace("tyre", "base_link").encode("utf-16")
    report = checked({"model.sdf": unused}, tmp_path)
    assert [each.rule for each in report.findings] == ["CFG002"]


def test_comments_can_be_set_aside_themselves(tmp_path: Path) -> None:
    fragment = axle(f"{ignore('CFG002')} {ignore('KIN001')}\n<child>base_link</child>")
    report = checked(fragment, tmp_path)
    assert found(report) == []
    assert set_aside(report) == [("CFG002", "comment", REASON)]


MARKER = r"(?<=<!-- )\^ {0}(?= *-->)|(?<=# )\^ {0}$"


def _with_comments(rule: Rule, example: Any) -> Any:
    """Return an example whose markers are suppressions; they stand in comments anyway."""
    marker = re.compile(MARKER.format(rule.id), re.MULTILINE)
    comment = f"subt-check: ignore[{rule.id}] {REASON}"
    if isinstance(example, str):
        return marker.sub(comment, example)
    return {
        path: marker.sub(comment, text) if isinstance(text, str) else text
        for path, text in example.items()
    }


def _cases() -> list[Any]:
    """Return of each rule the first example whose marks are all comments of ours."""
    cases = []
    for rule in all_rules():
        for example in rule.bad if rule.group not in ("CFG", "TRI", "MSH") else ():
            marked = _with_comments(rule, example)
            texts = list(marked.values()) if isinstance(marked, Mapping) else [marked]
            said = "".join(text for text in texts if isinstance(text, str))
            if REASON in said and f"^ {rule.id}" not in said and "@reported" not in marked:
                cases.append(pytest.param(rule, marked, id=rule.id))
                break
    return cases


@pytest.mark.parametrize(("rule", "example"), _cases())
def test_what_any_rule_finds_can_be_set_aside(rule: Rule, example: Any, tmp_path: Path) -> None:
    profile = profile_of(rule, example).name
    report = checked_again(write_example(example, tmp_path), rule.id, profile=profile)
    assert found(report) == []
    assert {each.finding.rule for each in report.suppressed} == {rule.id}
    assert {each.reason for each in report.suppressed} == {REASON}
