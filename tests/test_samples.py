"""Every sample gets the report that lies beside it, and every fault put there is found."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from checker.pipeline import check_package
from checker.report.json_report import to_json
from checker.report.report import Cause, PackageReport, VerdictKind
from checker.rulebook.discovery import all_rules
from checker.settings import Settings
from tests.conftest import SAMPLES

NAMES = sorted(folder.name for folder in SAMPLES.iterdir() if (folder / "package.xml").is_file())
BROKEN = [name for name in NAMES if name.startswith("broken_")]
OLD = "husky_description"
"""As Gazebo 9 had it: names and angles are as the Model Migration Guide finds them."""
MISSING = (Cause.NOT_APPLICABLE, Cause.NOT_AT_HAND)
GOOD = [name for name in NAMES if name not in (*BROKEN, OLD)]
SCHEMA = json.loads((SAMPLES.parent / "checker/report/report.schema.json").read_text("utf-8"))


def report_of(name: str) -> PackageReport:
    """Return the report of the package itself; its worlds have reports of their own."""
    return next(package for package in reports_of(name) if package.name == name)


def reports_of(name: str) -> tuple[PackageReport, ...]:
    return check_package(SAMPLES / name, Settings()).packages


def golden(name: str) -> dict[str, Any]:
    """Return the report without what differs between machines and runs.

    Of rules whose parts are missing only the reasons are kept, so that a new rule changes nothing.
    """
    report = json.loads(to_json(check_package(SAMPLES / name, Settings())))
    del report["tool"]["versions"]
    for package in report["packages"]:
        del package["timings"]
        unchecked = package["not_checked"]
        package["not_checked"] = [it for it in unchecked if it["cause"] not in MISSING]
        package["missing"] = sorted({it["reason"] for it in unchecked if it["cause"] in MISSING})
        package["path"] = package["name"]
        if package["trial"] is not None:
            package["trial"] = compact(package["trial"])
        package["other_trials"] = [compact(trial) for trial in package["other_trials"]]
    plain: dict[str, Any] = json.loads(json.dumps(report))
    return plain


def compact(trial: dict[str, Any]) -> dict[str, Any]:
    """Return a trial with the names of its series alone and figures as they agree anywhere."""
    figures = [each | {"value": round(each["value"], 2)} for each in trial["measurements"]]
    changes = {"versions": {}, "measurements": figures, "series": sorted(trial["series"])}
    return trial | changes


@pytest.mark.parametrize("name", NAMES)
def test_report_is_the_one_beside_the_sample(name: str, pytestconfig: pytest.Config) -> None:
    beside = SAMPLES / f"{name}.report.json"
    report = golden(name)
    if pytestconfig.getoption("--update-golden"):
        beside.write_text(json.dumps(report, indent=1, ensure_ascii=False) + "\n", "utf-8")
    assert report == json.loads(beside.read_text("utf-8"))


@pytest.mark.parametrize("name", NAMES)
def test_report_is_valid(name: str) -> None:
    report = to_json(check_package(SAMPLES / name, Settings()))
    jsonschema.validate(json.loads(report), SCHEMA)


@pytest.mark.parametrize("name", GOOD)
def test_a_good_sample_is_ready_and_nothing_is_said_about_it(name: str) -> None:
    package = report_of(name)
    assert not [f"{each.rule}: {each.message}" for each in package.findings]
    assert not package.blind_spots
    assert package.verdict is VerdictKind.READY


def test_the_old_sample_shows_what_a_migration_mends() -> None:
    assert {each.rule for each in report_of(OLD).findings} == {"GEO001", "KIN011"}


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_sample_is_not_ready(name: str) -> None:
    assert report_of(name).verdict is VerdictKind.NOT_READY


Fault = tuple[str, str, int]
"""Rule, file (empty for the package), and line (1 where it cannot have any other)."""


def faults_listed(name: str) -> set[Fault]:
    """Return the faults that the table beside a broken sample lists, for rules that exist."""
    rules = {rule.id for rule in all_rules()}
    table = (SAMPLES / f"{name}.faults.md").read_text("utf-8")
    rows = re.findall(r"^\| ([A-Z][A-Z0-9]*\d+) \| (.+?) \| (\d+|–) \|", table, re.MULTILINE)
    assert len(rows) > 20
    return {
        (rule, "" if file == "(package)" else file, 1 if line == "–" else int(line))
        for rule, file, line in rows
        if rule in rules
    }


def faults_reported(name: str) -> set[Fault]:
    return {
        (finding.rule, _from_sample(name, package, place.file), place.line)
        for package in reports_of(name)
        for finding in package.findings
        for place in finding.places
        if not place.note
    }


def _from_sample(name: str, package: PackageReport, file: str) -> str:
    """Return the path of a file from the sample; its worlds are checked by themselves."""
    folder = Path(package.path).relative_to(SAMPLES / name)
    return (folder / file).as_posix() if file else ""


@pytest.mark.parametrize("name", BROKEN)
def test_every_fault_of_a_broken_sample_is_reported(name: str) -> None:
    assert not sorted(faults_listed(name) - faults_reported(name))


@pytest.mark.parametrize("name", BROKEN)
def test_nothing_else_is_reported_about_a_broken_sample(name: str) -> None:
    assert not sorted(faults_reported(name) - faults_listed(name))
