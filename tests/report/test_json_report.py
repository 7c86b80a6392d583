"""The JSON report follows its schema, whatever was found."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.finding import Concern, Edit, Fix, Place, Safety, Severity
from checker.package.kind import PackageKind
from checker.pipeline import check_package
from checker.report.json_form import report_schema
from checker.report.json_report import to_json
from checker.report.report import (
    Cause,
    NotChecked,
    NotOpened,
    PackageReport,
    Report,
    ReportedFinding,
    VerdictKind,
)
from checker.settings import Settings
from tests.test_samples import SCHEMA

ROOT = Path(__file__).parents[2]

NOT_AT_HAND = NotChecked("SEN001", "it lies elsewhere", Cause.NOT_AT_HAND)
CRASHED = NotChecked("SEN001", "it could not run", Cause.CRASHED)
OFF = NotChecked("SEN001", "switched off", Cause.SWITCHED_OFF)
NOTHING_THERE = NotChecked("SEN001", "the package has none", Cause.NOT_APPLICABLE)


def found(severity: Severity) -> ReportedFinding:
    return ReportedFinding(
        "SEN005", "fault", severity, Concern.ROBOT, "is 3", "0" * 16, (Place("a"),)
    )


def package(*not_checked: NotChecked, severities: tuple[Severity, ...] = ()) -> PackageReport:
    return PackageReport("r", "r", "robot", tuple(map(found, severities)), not_checked)


def test_the_schema_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


def test_the_schema_is_that_of_the_types(pytestconfig: pytest.Config) -> None:
    path = ROOT / "checker/report/report.schema.json"
    generated = json.dumps(report_schema(), indent=2) + "\n"
    if pytestconfig.getoption("--update-golden"):
        path.write_text(generated, "utf-8")
    assert path.read_text("utf-8") == generated, "run `make golden`"


def test_the_verdict() -> None:
    error, warning = Severity.ERROR, Severity.WARNING
    assert package().verdict is VerdictKind.READY
    assert package(severities=(warning,)).verdict is VerdictKind.READY
    assert package(OFF, NOTHING_THERE).verdict is VerdictKind.READY
    assert package(NOT_AT_HAND, severities=(warning,)).verdict is VerdictKind.INCOMPLETE
    assert package(CRASHED).verdict is VerdictKind.INCOMPLETE
    assert package(NOT_AT_HAND, severities=(error,)).verdict is VerdictKind.NOT_READY


def test_the_verdict_sets_paperwork_apart() -> None:
    papers = replace(found(Severity.ERROR), concern=Concern.PAPERWORK)
    only = replace(package(), findings=(papers,))
    assert only.verdict is VerdictKind.PAPERWORK
    both = replace(only, findings=(papers, found(Severity.ERROR)))
    assert both.verdict is VerdictKind.NOT_READY
    hidden = replace(NOT_AT_HAND, severity=Severity.ERROR, concern=Concern.ROBOT)
    assert replace(only, not_checked=(hidden,)).verdict is VerdictKind.INCOMPLETE
    same = replace(hidden, concern=Concern.PAPERWORK)
    assert replace(only, not_checked=(same,)).verdict is VerdictKind.PAPERWORK
    assert package(same).verdict is VerdictKind.INCOMPLETE


def test_a_rule_that_never_reports_errors_hides_none() -> None:
    minor = replace(NOT_AT_HAND, severity=Severity.WARNING, concern=Concern.ROBOT)
    assert package(minor).verdict is VerdictKind.READY


@given(st.text(st.characters(exclude_categories=())), st.sampled_from(PackageKind))
def test_any_text_makes_a_valid_report_that_is_safe_to_print(text: str, kind: PackageKind) -> None:
    place = Place(text, element=text, note=text, snippet=text)
    fix = Fix(Safety.SAFE, (Edit(place, text, text),))
    finding = ReportedFinding(
        "SEN005",
        "a-fault",
        Severity.INFO,
        Concern.PAPERWORK,
        f"x{text}",
        "0" * 16,
        (place,),
        fix,
        text,
        text,
    )
    one = PackageReport(text, text, str(kind), (finding,), (NOT_AT_HAND,), facts={"robot": text})
    written = to_json(Report((one,), {"python": "3"}, (NotOpened(text, text, failed=True),)))
    again = json.loads(written.encode("utf-8"))
    jsonschema.validate(again, SCHEMA)
    assert again["packages"][0]["name"] == json.loads(json.dumps(text))
    assert not [c for c in written if c != "\n" and (ord(c) < 32 or 127 <= ord(c) < 160)]


def test_every_package_of_the_corpus_is_checked_to_the_end(corpus: Path) -> None:
    report = check_package(corpus, Settings())
    folders = {path.parent.name for path in corpus.glob("*/package.xml")}
    assert {each.name for each in report.packages} == folders
    assert len(folders) == 18
    jsonschema.validate(json.loads(to_json(report)), SCHEMA)
    for each in report.packages:
        assert not each.crashed, each.not_checked
        assert all(part.at_hand for part in each.inherited)
        assert each.facts["links"] > 0
        assert each.kind in ("robot", "configuration")
        assert len({finding.fingerprint for finding in each.findings}) == len(each.findings)


def test_packages_without_a_model_inherit_their_siblings(corpus: Path) -> None:
    report = check_package(corpus, Settings())
    aliases = {each.name for each in report.packages if each.kind == "configuration"}
    without = {path.name for path in corpus.iterdir() if path.is_dir()} - {
        path.parent.name for path in corpus.glob("*/model.sdf")
    }
    assert aliases == without
    assert len(aliases) == 4
