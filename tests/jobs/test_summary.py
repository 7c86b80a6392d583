"""What a worker believes of its child: a summary of the right form, in bounds."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.finding import Concern, Severity
from checker.report.report import (
    Cause,
    NotChecked,
    PackageReport,
    Report,
    ReportedFinding,
)
from checker.service.jobs.exchange import read_summary, summary
from checker.service.jobs.outcome import Checked

FINDING = ReportedFinding("XML001", "odd", Severity.WARNING, Concern.ROBOT, "is odd", "f", ())
PACKAGE = {
    "name": "a",
    "folder": "",
    "kind": "robot",
    "verdict": "ready",
    "errors": 0,
    "warnings": 1,
    "infos": 0,
}
SAID = {"packages": [PACKAGE], "words": "Ready"}
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=9),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=9), inner),
)


def packages(*names: str, crashed: bool = False) -> Report:
    blind = (NotChecked("XML001", "crashed", Cause.CRASHED),) if crashed else ()
    made = (PackageReport(name, name, "robot", (FINDING,), blind) for name in names)
    return Report(tuple(made), {})


@pytest.mark.parametrize("names", [("rover",), ("rover", "arm"), ("x/1", "x 1", "</script>\u202e")])
def test_what_is_written_is_read(names: tuple[str, ...]) -> None:
    said = summary(packages(*names))
    checked = read_summary("key", said)
    assert isinstance(checked, Checked)
    assert list(checked.packages) == said["packages"]
    assert [package["warnings"] for package in checked.packages] == [1] * len(names)
    folders = [package["folder"] for package in checked.packages]
    assert folders == [""] or len(set(folders)) == len(names)


def test_the_words() -> None:
    assert summary(packages("a"))["words"] == "Ready: 1 warning"
    assert summary(packages("a", "b", "c"))["words"] == "3 packages: 3 ready"
    robot, world = packages("a", "hall.sdf").packages
    beside = Report((robot, replace(world, kind="world")), {})
    assert summary(beside)["words"] == "1 package and 1 world: 2 ready"


def test_a_rule_that_crashed() -> None:
    assert summary(packages("a", crashed=True))["crashed"] is True
    assert summary(packages("a"))["crashed"] is False


@pytest.mark.parametrize(
    "change",
    [
        {"errors": -1},
        {"errors": True},
        {"errors": "<b>"},
        {"verdict": "splendid"},
        {"name": 3},
        {"name": "x" * 2_000},
        {"name": "\ud800"},
        {"folder": "a/\udfff"},
        {"folder": None},
    ],
)
def test_a_package_of_another_form(change: dict[str, Any]) -> None:
    assert read_summary("key", SAID) is not None
    assert read_summary("key", {**SAID, "packages": [PACKAGE | change]}) is None


def test_more_than_the_form_says_is_dropped() -> None:
    checked = read_summary("key", {**SAID, "packages": [{**PACKAGE, "html": "<script>"}]})
    assert checked is not None
    assert checked.packages == (PACKAGE,)


def test_too_many_packages() -> None:
    assert read_summary("key", {**SAID, "packages": [PACKAGE] * 5_001}) is None


@given(JSON)
def test_anything_else_is_no_summary(said: object) -> None:
    assert read_summary("key", said) is None
    assert read_summary("key", {**SAID, "packages": [said]}) is None
