"""What the engine does with rules: hands over parts, isolates, selects, weighs."""

from __future__ import annotations

import errno
from typing import Any

import pytest

from checker.base.allowance import Allowance
from checker.base.parts import NotAvailable
from checker.engine.judge import Judge
from checker.engine.run import run_rules
from checker.formats.xacro.files import ROOT
from checker.report.report import Cause, NotChecked
from checker.rule import Concern, Context, Findings, Rule, Severity, finding, unchecked
from checker.settings import Settings
from tests.engine.stage import Parts, Wheel, at, reported, rule_saying, run, subt


def rule_of(check: object, id: str = "TST009") -> Rule:
    return Rule(id, "fault", Severity.ERROR, Concern.ROBOT, check, "Something.")  # type: ignore[arg-type]  # any


def broken(wheel: Wheel) -> Findings:
    yield finding(wheel.place, "first")
    raise KeyError("second")


def endless(wheel: Wheel) -> Findings:
    yield from endless(wheel)


def looking(wheel: Wheel, context: Context) -> Findings:
    yield finding(wheel.place, f"seen for {context.release}")


def looking_away(wheel: Wheel) -> Findings:
    yield unchecked("the mesh is not available")
    yield unchecked("the mesh is not available")
    yield finding(wheel.place, "seen all the same")


def showing_paths(wheel: Wheel) -> Findings:
    yield unchecked(f"{ROOT}/rover/a.yaml is too large")
    yield finding(wheel.place, f"mesh '{ROOT}/rover/meshes/a.stl' is not there")


def with_options(wheel: Wheel, *, limit: float = 1.0, names: tuple[str, ...] = ()) -> Findings:
    yield finding(wheel.place, f"{type(limit).__name__} {limit}, {names!r}")


@pytest.mark.parametrize(("check", "error"), [(broken, "KeyError"), (endless, "RecursionError")])
def test_a_rule_that_crashes_is_named_and_the_others_go_on(check: object, error: str) -> None:
    outcome = run(rule_of(check), rule_saying(finding(at(1), "found")))
    assert reported(outcome) == ["TST001"]
    (crash,) = outcome.not_checked
    assert (crash.rule, crash.cause) == ("TST009", Cause.CRASHED)
    assert error in crash.reason


def test_a_made_up_folder_is_not_shown() -> None:
    outcome = run(rule_of(showing_paths))
    (found,), (skipped,) = outcome.findings, outcome.not_checked
    assert found.message == "mesh '$(find rover)/meshes/a.stl' is not there"
    assert skipped.reason == "$(find rover)/a.yaml is too large"


def without_disk(_: Wheel) -> Findings:
    raise OSError(errno.ENOSPC, "No space left on device")
    yield


def test_a_rule_that_the_system_stops_did_not_crash() -> None:
    (stopped,) = run(rule_of(without_disk)).not_checked
    assert (stopped.rule, stopped.cause, stopped.momentary) == ("TST009", Cause.NOT_AT_HAND, True)
    assert "No space left on device" in stopped.reason


def too_slow(_: Wheel) -> Findings:
    while True:
        pass
    yield


def too_large(_: Wheel) -> Findings:
    raise MemoryError
    yield


@pytest.mark.parametrize(
    ("check", "reason"),
    [
        (too_slow, "TST009 needs more than 0.2 s of processor time"),
        (too_large, "TST009 needs more memory than there is"),
    ],
)
def test_a_rule_that_needs_too_much_is_not_checked(check: object, reason: str) -> None:
    rules = (rule_of(check), rule_saying(finding(at(1), "found")))
    outcome = run_rules(rules, Parts(Wheel()), Judge(subt(), Settings()), allowance=Allowance(0.2))
    assert reported(outcome) == ["TST001"]
    (unseen,) = outcome.not_checked
    assert (unseen.rule, unseen.cause, unseen.reason) == ("TST009", Cause.NOT_AT_HAND, reason)
    assert not unseen.momentary


def test_a_rule_gets_the_parts_and_the_context_that_it_asks_for() -> None:
    (found,) = run(rule_of(looking)).findings
    assert found.message == "seen for dome"


def test_a_rule_runs_once_for_each_of_several_parts() -> None:
    (found,) = run(rule_of(looking), parts=Parts(Wheel(1), Wheel(7))).findings
    assert [place.line for place in found.places] == [1, 7]


@pytest.mark.parametrize(
    ("applicable", "cause"), [(True, Cause.NOT_AT_HAND), (False, Cause.NOT_APPLICABLE)]
)
def test_a_part_that_is_not_at_hand_is_the_reason_not_to_look(
    applicable: bool, cause: Cause
) -> None:
    parts = Parts(missing=NotAvailable("it lies elsewhere", applicable))
    outcome = run(rule_of(looking), parts=parts)
    unseen = NotChecked("TST009", "it lies elsewhere", cause, Severity.ERROR, Concern.ROBOT)
    assert outcome.not_checked == (unseen,)


def test_a_rule_can_say_what_it_could_not_look_at_and_go_on() -> None:
    outcome = run(rule_of(looking_away))
    assert reported(outcome) == ["TST009"]
    reason = NotChecked(
        "TST009", "the mesh is not available", Cause.NOT_AT_HAND, Severity.ERROR, Concern.ROBOT
    )
    assert outcome.not_checked == (reason,)


A = rule_saying(finding(at(1), "a"), id="AAA001")
B = rule_saying(finding(at(2), "b"), id="AAA002")
C = rule_saying(finding(at(3), "c"), id="BBB001")


@pytest.mark.parametrize(
    ("settings", "expected"),
    [
        ({}, ["AAA001", "AAA002", "BBB001"]),
        ({"select": ("AAA001",)}, ["AAA001"]),
        ({"select": ("AAA",)}, ["AAA001", "AAA002"]),
        ({"select": ("fault-bbb001",)}, ["BBB001"]),
        ({"ignore": ("AAA",)}, ["BBB001"]),
        ({"ignore": ("fault-aaa002", "BBB001")}, ["AAA001"]),
        ({"select": ("AAA",), "ignore": ("AAA001",)}, ["AAA002"]),
    ],
)
def test_rules_are_chosen_by_id_group_or_name(
    settings: dict[str, Any], expected: list[str]
) -> None:
    assert reported(run(A, B, C, **settings)) == expected


def test_of_a_group_only_the_rules_of_the_profile_run() -> None:
    rule = rule_saying(finding(at(1), "odd"), id="SDF901")
    judge = subt(rules=("SDF",), without=("SDF901",))
    outcome = run(rule, profile=judge, select=("SDF",))
    assert not outcome.findings
    (skipped,) = outcome.not_checked
    assert skipped.reason == "not in the profile subt; `--select SDF901` runs it"
    assert reported(run(rule, profile=judge, select=("SDF901",))) == ["SDF901"]


def test_what_is_switched_off_is_said_what_was_not_selected_is_not() -> None:
    off = NotChecked("BBB001", "switched off", Cause.SWITCHED_OFF)
    assert run(A, B, C, ignore=("BBB",)).not_checked == (off,)
    assert run(A, B, C, select=("AAA",)).not_checked == ()


def test_a_profile_leaves_out_rules_but_not_the_groups_of_other_people() -> None:
    known = rule_saying(finding(at(1), "x"), id="SDF001")
    strange = rule_saying(finding(at(1), "x"), id="ZZZ001")
    assert reported(run(known, strange, profile=subt(rules=("PKG",)))) == ["ZZZ001"]
    assert reported(run(known, profile=subt(without=("SDF001",)))) == []


@pytest.mark.parametrize(
    ("own", "of_profile", "of_user", "expected"),
    [
        (Severity.ERROR, None, None, Severity.ERROR),
        (Severity.ERROR, Severity.WARNING, None, Severity.WARNING),
        (Severity.INFO, Severity.WARNING, None, Severity.INFO),
        (Severity.ERROR, Severity.WARNING, Severity.INFO, Severity.INFO),
        (Severity.INFO, None, Severity.ERROR, Severity.ERROR),
    ],
)
def test_severity_is_the_users_else_the_milder_of_rule_and_profile(
    own: Severity, of_profile: Severity | None, of_user: Severity | None, expected: Severity
) -> None:
    rule = rule_saying(finding(at(1), "x"), id="SDF001", severity=own)
    profile = subt(severity={"SDF001": of_profile} if of_profile else {})
    severity = {"SDF001": of_user} if of_user else {}
    (found,) = run(rule, profile=profile, severity=severity).findings
    assert found.severity is expected


def test_a_finding_may_have_a_severity_of_its_own() -> None:
    (found,) = run(rule_saying(finding(at(1), "x", severity=Severity.INFO))).findings
    assert found.severity is Severity.INFO


def test_options_come_from_the_signature_and_keep_its_types() -> None:
    rule = rule_of(with_options)
    assert rule.options == {"limit": 1.0, "names": ()}
    (found,) = run(rule, options={"TST009": {"limit": 3, "names": ["a"]}}).findings
    assert found.message == "float 3.0, ('a',)"


def test_errors_stand_first_then_files_and_lines() -> None:
    outcome = run(
        rule_saying(finding(at(9), "late"), finding(at(2), "early"), id="AAA001"),
        rule_saying(finding(at(1, file="a.xml"), "other file"), id="AAA002"),
        rule_saying(finding(at(1), "mild"), id="AAA000", severity=Severity.WARNING),
    )
    assert [each.message for each in outcome.findings] == ["other file", "early", "late", "mild"]
