"""The baseline's file, and what becomes of it when a package is checked."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.errors import InvalidSettings
from checker.cli.check.baseline import baseline_to_renew
from checker.finding import Severity
from checker.report.report import IN_BASELINE
from checker.rule_testing import write_example
from checker.rulebook.example_files import NAME
from checker.rulebook.suppression.baseline import (
    ENTRIES_LIMIT,
    SIZE_LIMIT,
    BaselineEntry,
    baseline_text,
    read_baseline,
)
from checker.rulebook.suppression.entries import REASON_LIMIT
from checker.settings import parse_settings
from tests.suppression.stage import axle, checked_again, found, set_aside

PLACE = f"model.sdf#sdf/model[{NAME}]/joint[axle]/child"
ENTRY = {"rule": "KIN001", "severity": "error", "message": "m", "places": {PLACE: 1}}

_texts = st.text(st.characters(exclude_categories=()), max_size=20)
_said = st.text(min_size=1, max_size=20)
_entries = st.builds(
    BaselineEntry,
    _said,
    st.sampled_from(Severity),
    _said,
    st.dictionaries(_texts, st.integers(1), min_size=1, max_size=3),
    _texts,
    _texts,
)


@given(packages=st.dictionaries(_texts, st.lists(_entries, max_size=4).map(tuple), max_size=3))
def test_what_is_written_is_read(
    tmp_path_factory: pytest.TempPathFactory, packages: dict[str, tuple[BaselineEntry, ...]]
) -> None:
    file = tmp_path_factory.mktemp("baseline") / "baseline.json"
    text = baseline_text(packages)
    assert text.isascii()
    file.write_text(text, "utf-8")
    read = read_baseline(file)
    assert (read.fault, read.packages) == ("", packages)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", "is not a baseline"),
        ("{", "is not a baseline"),
        ("[]", "it has no version"),
        ('{"version": 1, "packages": {}}', "it has version 1, expected 2"),
        ('{"version": 2}', "packages is not a table of lists"),
        ('{"version": 2, "packages": {"a": {}}}', "packages is not a table of lists"),
        ('{"version": 2, "packages": {"a": [7]}}', "an entry is not a table"),
        (
            '{"version": 2, "packages": {"a": [{"rule": 1}]}}',
            "an entry contains a value that is not a string",
        ),
        ('{"version": 2, "packages": {"a": [{"message": "b"}]}}', "an entry has no rule"),
        ("[" * 100_000, "is not a baseline"),
        ("\udcff", "is not a baseline"),
        (" " * (SIZE_LIMIT + 1), "has 5.0 MB, more than the limit of 5 MB"),
    ],
)
def test_what_is_no_baseline_says_why(text: str, fault: str, tmp_path: Path) -> None:
    file = tmp_path / "baseline.json"
    file.write_text(text, "utf-8", "surrogateescape")
    assert fault in read_baseline(file).fault


@pytest.mark.parametrize(
    ("more", "fault"),
    [
        ({"severity": "grave"}, "an entry has severity 'grave'"),
        ({"severity": ["error"]}, r"an entry has severity ['error']"),
        ({"places": {"a": 0}}, "no places with their counts"),
        ({"places": {"a": True}}, "no places with their counts"),
        ({"places": ["a"]}, "no places with their counts"),
        ({"places": None}, "no places with their counts"),
        ({"reason": 7}, "an entry contains a value that is not a string"),
    ],
)
def test_an_entry_of_another_form_says_why(
    more: dict[str, object], fault: str, tmp_path: Path
) -> None:
    file = written(tmp_path / "b.json", {**ENTRY, **more})
    assert fault in read_baseline(file).fault


def written(file: Path, *entries: object) -> Path:
    content = {"version": 2, "packages": {NAME: entries}}
    file.write_text(json.dumps(content), "utf-8")
    return file


def test_a_baseline_is_bounded(tmp_path: Path) -> None:
    short = {"rule": "A", "severity": "info", "message": "m", "places": {"b": 1}}
    file = written(tmp_path / "b.json", *[short] * (ENTRIES_LIMIT + 1))
    assert "has 20001 entries, more than the limit of 20000" in read_baseline(file).fault
    file = written(tmp_path / "b.json", {**ENTRY, "reason": "x" * 2 * REASON_LIMIT})
    ((entry,),) = read_baseline(file).packages.values()
    assert len(entry.reason) == REASON_LIMIT


def test_what_would_not_be_read_is_not_written() -> None:
    entry = BaselineEntry("A", Severity.INFO, "m" * 1_000, {"b": 1})
    with pytest.raises(ValueError, match="would have 20001 entries"):
        baseline_text({"a": [entry] * (ENTRIES_LIMIT + 1)})
    with pytest.raises(ValueError, match=r"would have \d\.\d MB, more than the limit of 5 MB"):
        baseline_text({"a": [entry] * 6_000})


def test_a_missing_file_is_named_as_it_is_to_be_given(tmp_path: Path) -> None:
    file = tmp_path / "below" / "none.json"
    fault = read_baseline(file).fault
    assert fault == f"does not exist; create it with --write-baseline --baseline {file}"


@pytest.mark.parametrize(
    "name", ["x" * 5_000, "a" * 300 + "/b", "loop", "loop/b", "gone", "file/b", "a\0b"]
)
def test_a_path_that_leads_nowhere_is_a_fault(name: str, tmp_path: Path) -> None:
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "gone").symlink_to("nowhere")
    (tmp_path / "file").touch()
    fault = read_baseline(tmp_path / name).fault
    assert fault.startswith(("cannot be read: ", "is a broken link"))
    with pytest.raises(InvalidSettings, match="remove it, or name another file"):
        baseline_to_renew(tmp_path / name)
    if "loop" in name or "\0" in name:
        with pytest.raises(InvalidSettings, match="below the folder of these settings"):
            parse_settings({"baseline": name}, tmp_path / "subt-check.toml")
    else:
        settings = parse_settings({"baseline": name}, tmp_path / "subt-check.toml")
        assert settings.baseline.fault == fault


def in_baseline(package: Path, **more: object) -> None:
    written(package / "b.json", {**ENTRY, **more})
    (package / "subt-check.toml").write_text('baseline = "b.json"\n', "utf-8")


def test_settings_name_a_baseline(tmp_path: Path) -> None:
    package = write_example(axle(), tmp_path)
    in_baseline(package)
    report = checked_again(package)
    assert (found(report), set_aside(report)) == ([], [("KIN001", "baseline", IN_BASELINE)])
    assert "baseline b.json" in report.settings
    in_baseline(package, reason="next year")
    assert set_aside(checked_again(package)) == [("KIN001", "baseline", "next year")]


def test_what_is_graver_than_it_was_counts(tmp_path: Path) -> None:
    package = write_example(axle(), tmp_path)
    in_baseline(package, severity="warning")
    report = checked_again(package)
    assert [each.rule for each in report.findings] == ["KIN001"]
    assert report.suppressed == ()


def test_what_is_gone_is_reported(tmp_path: Path) -> None:
    package = write_example(axle("<child>base_link</child>"), tmp_path)
    in_baseline(package)
    (gone,) = checked_again(package).findings
    assert (gone.rule, gone.severity) == ("CFG004", "info")
    assert gone.message == "b.json contains findings of KIN001 that no longer occur: 'm'"
    in_baseline(package, rule="KIN002")  # did not look
    assert found(checked_again(package)) == []


def test_rules_that_do_not_exist_are_one_finding(tmp_path: Path) -> None:
    package = write_example(axle("<child>base_link</child>"), tmp_path)
    (package / "subt-check.toml").write_text('baseline = "b.json"\n', "utf-8")
    written(package / "b.json", *({**ENTRY, "rule": f"OLD{n}"} for n in range(1_000)))
    (gone,) = checked_again(package).findings
    said = "findings of rules that do not exist: 'OLD0' and 999 more"
    assert gone.message == f"b.json contains {said}"


def turned(*names: str, roll: str = "1.57") -> str:
    """Return visuals with an angle each that GEO001 joins to one finding."""
    pose = f"<pose>0 0 0 {roll} 0 0</pose><geometry><box/></geometry>"
    return "\n".join(f"<visual name='{name}'>{pose}</visual>" for name in names)


def test_new_places_of_an_old_finding_are_reported(tmp_path: Path) -> None:
    package = write_example(turned("a", "b"), tmp_path)
    (old,) = checked_again(package, "GEO001").findings
    here = {place.element for place in old.places}
    places = {f"model.sdf#{element}": 1 for element in here}
    entry = {"rule": "GEO001", "severity": old.severity, "message": "x", "key": old.key}
    write_example(turned("c", "a", "b"), tmp_path)
    (package / "subt-check.toml").write_text('baseline = "b.json"\n', "utf-8")
    written(package / "b.json", {**entry, "places": places})
    report = checked_again(package, "GEO001")
    (new,), (aside,) = report.findings, report.suppressed
    assert "visual[c]" in new.places[0].element
    assert len(new.places) == 1
    assert new.fix is not None
    assert {edit.place.line for edit in new.fix.edits} == {new.places[0].line}
    assert {place.element for place in aside.finding.places} == here
    assert new.fingerprint != aside.finding.fingerprint
    write_example(turned("c", "b"), tmp_path)  # one gone, another new
    report = checked_again(package, "GEO001")
    assert ["visual[c]" in each.places[0].element for each in report.findings] == [True]
    assert len(report.suppressed[0].finding.places) == 1


@pytest.mark.parametrize("path", ["/etc/passwd", "../b.json", "a/../../b.json", "link", "", 7])
def test_settings_name_no_file_elsewhere(path: object, tmp_path: Path) -> None:
    folder = tmp_path / "package"
    folder.mkdir()
    (folder / "link").symlink_to("/etc/passwd")
    with pytest.raises(InvalidSettings, match="below the folder of these settings"):
        parse_settings({"baseline": path}, folder / "subt-check.toml")
