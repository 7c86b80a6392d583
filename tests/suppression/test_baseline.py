"""Findings that were there before: the file, and what in it is the same fault as one of now."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.errors import InvalidSettings
from checker.finding import Place, Severity
from checker.fingerprint import numbered
from checker.report.report import IN_BASELINE, ReportedFinding
from checker.settings import parse_settings
from checker.suppression.baseline import BaselineEntry, baseline_text, read_baseline
from checker.suppression.matching import matched, stale_by_rule
from tests.examples import NAME, write_example
from tests.suppression.stage import axle, checked_again, found, set_aside

_texts = st.text(max_size=20)
_entries = st.builds(BaselineEntry, _texts, _texts, _texts, _texts, _texts)


@given(packages=st.dictionaries(_texts, st.lists(_entries, max_size=4).map(tuple), max_size=3))
def test_what_is_written_is_read(
    tmp_path_factory: pytest.TempPathFactory, packages: dict[str, tuple[BaselineEntry, ...]]
) -> None:
    file = tmp_path_factory.mktemp("baseline") / "baseline.json"
    text = baseline_text(packages)
    assert text.isascii()
    file.write_text(text, "utf-8")
    read = read_baseline(file)
    complete = {
        n: tuple(e for e in es if all((e.rule, e.message, e.fingerprint)))
        for n, es in packages.items()
    }
    if complete == packages:
        assert (read.fault, read.packages) == ("", packages)
    else:
        assert "an entry has no" in read.fault


def finding(base: str, message: str, key: str = "", rule: str = "KIN001") -> ReportedFinding:
    place = (Place("model.sdf"),)
    return ReportedFinding(rule, "name", Severity.ERROR, message, base, place, key=key)


def findings(*said: tuple[str, str]) -> list[ReportedFinding]:
    prints = numbered([base for base, _ in said])
    return [finding(own, message) for own, (_, message) in zip(prints, said, strict=True)]


def entries(said: list[ReportedFinding]) -> list[BaselineEntry]:
    return [BaselineEntry(each.fingerprint, each.rule, each.message, each.key) for each in said]


def left(now: list[ReportedFinding], before: list[ReportedFinding]) -> list[str]:
    return [each.message for each in matched(now, entries(before)).left]


def stale(now: list[ReportedFinding], before: list[ReportedFinding]) -> list[str]:
    return [each.message for each in matched(now, entries(before)).stale]


_said = st.lists(st.tuples(st.sampled_from("abc"), st.sampled_from("xyz")), max_size=12)


@given(_said)
def test_what_did_not_change_is_in_the_baseline(said: list[tuple[str, str]]) -> None:
    same = findings(*said)
    assert left(same, same) == stale(same, same) == []


@given(_said, _said)
def test_every_finding_takes_one_entry(
    one: list[tuple[str, str]], other: list[tuple[str, str]]
) -> None:
    now, before = findings(*one), findings(*other)
    found = matched(now, entries(before))
    assert len(found.findings) == len(now)
    assert len(found.suppressed) + len(found.left) == len(now)
    assert len(found.suppressed) + len(found.stale) == len(before)


@given(_said, st.integers(0, 11))
def test_mending_one_leaves_nothing_new(said: list[tuple[str, str]], mended: int) -> None:
    now = said[:mended] + said[mended + 1 :]
    assert left(findings(*now), findings(*said)) == []
    assert len(stale(findings(*now), findings(*said))) == len(said) - len(now)


def test_of_equals_the_new_one_is_reported() -> None:
    before = findings(("a", "first"), ("a", "second"))
    now = findings(("a", "new"), ("a", "first"), ("a", "second"))
    assert left(now, before) == ["new"]


def test_a_value_may_change() -> None:
    assert left(findings(("a", "mass is 2")), findings(("a", "mass is 1"))) == []


def test_the_first_of_several_places_may_be_mended() -> None:
    """The fingerprint is that of the first place, the words are those of the fault."""
    assert left(findings(("b", "angle is 1.57")), findings(("a", "angle is 1.57"))) == []
    keyed = matched([finding("b", "one", "k")], entries([finding("a", "other", "k")]))
    assert keyed.left == ()


def test_stale_entries_are_those_of_rules_that_looked_or_are_gone() -> None:
    old = [BaselineEntry("0", rule, "m") for rule in ("KIN001", "KIN001", "KIN002", "OLD001")]
    said = stale_by_rule(old, {"KIN001", "KIN002"}, {"KIN001"}, "b.json")
    assert [(each.rule, each.messages) for each in said] == [
        ("KIN001", ("m", "m")),
        ("OLD001", ("m",)),
    ]


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", "is no baseline"),
        ("{", "is no baseline"),
        ("[]", "it has no version"),
        ('{"version": 2, "packages": {}}', "it has version 2, expected 1"),
        ('{"version": 1}', "packages is no table of lists"),
        ('{"version": 1, "packages": {"a": {}}}', "packages is no table of lists"),
        ('{"version": 1, "packages": {"a": [7]}}', "an entry is no table of texts"),
        ('{"version": 1, "packages": {"a": [{"rule": 1}]}}', "an entry is no table of texts"),
        ('{"version": 1, "packages": {"a": [{"rule": "b"}]}}', "an entry has no fingerprint"),
        ("[" * 100_000, "is no baseline"),
        ("\udcff", "is no baseline"),
    ],
)
def test_what_is_no_baseline_says_why(text: str, fault: str, tmp_path: Path) -> None:
    file = tmp_path / "baseline.json"
    file.write_text(text, "utf-8", "surrogateescape")
    assert fault in read_baseline(file).fault
    assert "does not exist" in read_baseline(tmp_path / "none.json").fault


def in_baseline(package: Path, rule: str = "KIN001", **more: str) -> None:
    entry = {"fingerprint": "0" * 16, "rule": rule, "message": "m", **more}
    content = {"version": 1, "packages": {NAME: [entry]}}
    (package / "b.json").write_text(json.dumps(content), "utf-8")
    (package / "subt-check.toml").write_text('baseline = "b.json"\n', "utf-8")


def test_settings_name_a_baseline(tmp_path: Path) -> None:
    package = write_example(axle(), tmp_path)
    (fault,) = checked_again(package).findings
    in_baseline(package, fingerprint=fault.fingerprint)
    report = checked_again(package)
    assert (found(report), set_aside(report)) == ([], [("KIN001", "baseline", IN_BASELINE)])
    assert "baseline b.json" in report.settings
    in_baseline(package, fingerprint=fault.fingerprint, reason="next year")
    assert set_aside(checked_again(package)) == [("KIN001", "baseline", "next year")]


def test_what_is_gone_is_reported(tmp_path: Path) -> None:
    package = write_example(axle("<child>base_link</child>"), tmp_path)
    in_baseline(package)
    (gone,) = checked_again(package).findings
    assert (gone.rule, gone.severity) == ("CFG004", "info")
    assert gone.message == "b.json holds what KIN001 finds no more: 'm'"
    in_baseline(package, rule="KIN002")  # did not look
    assert found(checked_again(package)) == []


@pytest.mark.parametrize("path", ["/etc/passwd", "../b.json", "a/../../b.json", "link", "", 7])
def test_settings_name_no_file_elsewhere(path: object, tmp_path: Path) -> None:
    folder = tmp_path / "package"
    folder.mkdir()
    (folder / "link").symlink_to("/etc/passwd")
    with pytest.raises(InvalidSettings, match="in the folder of these settings"):
        parse_settings({"baseline": path}, folder / "subt-check.toml")
