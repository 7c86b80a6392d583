"""Reasons for rules that were not checked."""

from __future__ import annotations

from checker.report.report import Cause, NotChecked
from checker.report.unseen import by_reason

_ABSENT = "is in hand, which is not available"


def _skipped(rule: str, reason: str) -> NotChecked:
    return NotChecked(rule, reason, Cause.NOT_AT_HAND)


def test_files_of_one_package_are_one_reason() -> None:
    first, second, third, last = by_reason(
        [
            _skipped("INE004", f"package://hand/a.stl {_ABSENT}"),
            _skipped("MSH001", f"package://hand/a.stl {_ABSENT}"),
            _skipped("MSH001", f"package://hand/b.stl {_ABSENT}"),
            _skipped("MSH001", "package://arm/a.stl is in arm, which is not available"),
            _skipped("MSH001", "meshes/a.stl does not exist"),
            _skipped("MSH001", "file:///a.stl is outside the workspace"),
            _skipped("MSH001", "file:///b.stl is outside the workspace"),
        ]
    )
    assert (
        first.reason == "package://hand/a.stl and 1 more file are in hand, which is not available"
    )
    assert first.rules == ("INE004", "MSH001")
    assert second.reason == "package://arm/a.stl is in arm, which is not available"
    assert third.reason == "meshes/a.stl does not exist"
    assert last.reason == "file:///a.stl and 1 more file are outside the workspace"


def test_other_causes_stay_apart() -> None:
    several = [
        NotChecked("MSH001", f"{name}.stl {_ABSENT}", cause)
        for name in "ab"
        for cause in (Cause.NOT_AT_HAND, Cause.SWITCHED_OFF)
    ]
    assert [it.cause for it in by_reason(several)] == [Cause.NOT_AT_HAND, Cause.SWITCHED_OFF]
