"""True findings are reported, and false ones are not."""

from __future__ import annotations

import pytest

from support.judgements import (
    HERE,
    by_check,
    findings,
    folder_of,
    is_reported,
    judgements,
    places,
)
from tests.tiers import MARKS

SOURCES = sorted(file.stem for file in HERE.glob("*.json"))
CHECKS = [(source, *check) for source in SOURCES for check in by_check(source)]
OF_THE_TRIAL = ("TRI",)

pytestmark = pytest.mark.corpus
assert "corpus" in MARKS


def needed(source: str) -> None:
    if folder_of(source) is None:
        pytest.skip(f"the packages of {source} are not there")


@pytest.mark.parametrize(("source", "path", "profile"), CHECKS, ids=lambda part: part)
def test_verdicts_hold(source: str, path: str, profile: str) -> None:
    needed(source)
    judged = by_check(source)[path, profile]
    driven = any(it.place.rule.startswith(OF_THE_TRIAL) for it in judged)
    found = findings(source, path, profile, trial=driven)
    wrong = [
        f"{it.verdict} {it.severity} {it.place}: {it.reason}"
        for it in judged
        if it.expected is not None and is_reported(it, found) is not it.expected
    ]
    assert not wrong, "\n".join(wrong)


def test_enough_is_judged() -> None:
    counts = {"error": 0, "warning": 0, "info": 0}
    for source in SOURCES:
        for judgement in judgements(source):
            counts[judgement.severity] += 1
    assert counts["error"] >= 300
    assert counts["warning"] >= 150


@pytest.mark.parametrize("source", SOURCES)
def test_every_error_is_judged_and_nearly_all_are_true(source: str) -> None:
    needed(source)
    known = {(it.path, it.place): it.verdict for it in judgements(source)}
    verdicts = [
        next((known[path, at] for at in places(found) if (path, at) in known), "not judged")
        for path, profile in by_check(source)
        for found in findings(source, path, profile, trial=False)
        if found.severity == "error"
    ]
    assert verdicts.count("not judged") == 0
    assert verdicts.count("true") >= 0.95 * len(verdicts)


def test_most_urdf_files_have_no_error() -> None:
    """Of 69 files: what has errors is judged, and read by people."""
    needed("urdf")
    folder = folder_of("urdf")
    assert folder is not None
    paths = sorted(str(file.relative_to(folder)) for file in folder.rglob("*.urdf"))
    assert len(paths) == 69
    clean = [
        path
        for path in paths
        if all(it.severity != "error" for it in findings("urdf", path, "urdf", trial=False))
    ]
    assert len(clean) >= 50
