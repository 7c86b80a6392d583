"""One fault that two rules see is reported once, by the more precise rule."""

import re
from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.rule import Rule, Severity, finding
from checker.rule_testing import write_example
from checker.rulebook.discovery import all_rules
from checker.settings import Settings
from tests.engine.stage import at, reported, rule_saying, run

PRECISE = rule_saying(finding(at(3, "link[a]"), "is 0.1, expected 0.2"), id="TST002")
PLACEHOLDER = """
<link name="box">
  <inertial>
    <mass>1</mass>
    <inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia>
  </inertial>
  <collision name="c"><geometry><box><size>0.1 0.1 0.1</size></box></geometry></collision>
</link>
<joint name="j" type="fixed"><parent>base_link</parent><child>box</child></joint>
"""
TEXTURE = """
<visual name="v">
  <geometry><mesh><uri>meshes/wheel.dae</uri></mesh></geometry>
  <material><pbr><metal><albedo_map>model://ACME_ROVER_SENSOR_CONFIG_1/a.png</albedo_map></metal></pbr></material>
</visual>
"""


def vague(line: int = 3, severity: Severity = Severity.ERROR) -> Rule:
    said = finding(at(line, "link[a]"), "odd", severity=severity, covered_by=("TST002",))
    return rule_saying(said, id="TST001")


def test_the_more_precise_rule_speaks_alone() -> None:
    assert reported(run(vague(), PRECISE)) == ["TST002"]


def test_elsewhere_both_speak() -> None:
    assert reported(run(vague(line=4), PRECISE)) == ["TST002", "TST001"]


def test_what_is_graver_is_said_all_the_same() -> None:
    note = rule_saying(finding(at(3, "link[a]"), "x", severity=Severity.INFO), id="TST002")
    assert reported(run(vague(), note)) == ["TST001", "TST002"]


def test_alone_the_other_speaks() -> None:
    assert reported(run(vague())) == ["TST001"]
    assert reported(run(vague(), PRECISE, ignore=("TST002",))) == ["TST001"]


def test_a_symptom_is_left_to_the_rule_that_tells_all_its_causes() -> None:
    causes = [(at(n, f"joint[{n}]"), "points down") for n in (5, 6)]
    symptom = finding(at(1, "plugin"), "turns right", related=causes, covered_by=("TST002",))
    one, both = (
        rule_saying(*(finding(at(n, f"joint[{n}]/axis"), f"axis {n}") for n in said), id="TST002")
        for said in ((5,), (5, 6))
    )
    assert reported(run(rule_saying(symptom), one)) == ["TST001", "TST002"]
    outcome = run(rule_saying(symptom), both)
    assert reported(outcome) == ["TST002", "TST002"]
    assert [each.rule for each in outcome.covered] == ["TST001"]


@pytest.mark.parametrize(
    ("fragment", "precise", "other"),
    [(PLACEHOLDER, "INE004", "INE007"), (TEXTURE, "REF002", "REF001")],
)
def test_real_rules_share_their_faults(
    fragment: str, precise: str, other: str, tmp_path: Path
) -> None:
    package = write_example(fragment, tmp_path)

    def found(*rules: str) -> set[str]:
        report = check_package(package, Settings(select=rules, trial=False))
        return {each.rule for each in report.packages[0].findings}

    assert found(other) == {other}
    assert found(precise, other) == {precise}


def test_rules_that_cover_others_exist() -> None:
    known = {rule.id for rule in all_rules()}
    rules = Path(__file__).parents[2] / "rules"
    named = {
        id
        for file in rules.rglob("*.py")
        for names in re.findall(r"(?:covered_by=|_MORE_PRECISE = ).*", file.read_text("utf-8"))
        for id in re.findall(r'"([A-Z0-9]{6})"', names)
    }
    assert len(named) > 3
    assert named <= known
