"""SARIF: valid by the published schema, and every index, place and mark means something."""

from __future__ import annotations

import json
import re
from typing import Any
from urllib.parse import unquote

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace
from sarif_pydantic import Sarif

from checker.finding import Concern, Edit, Fix, Place, Safety, Severity
from checker.pipeline import check_package
from checker.report.report import (
    Cause,
    NotChecked,
    NotOpened,
    PackageReport,
    Report,
    ReportedFinding,
    Suppressed,
    SuppressedBy,
)
from checker.report.sarif import RESULTS_LIMIT, to_sarif
from checker.report.sarif_places import EDITS_LIMIT, artifact, region
from checker.settings import Settings
from tests.conftest import SAMPLES
from tests.report.any_report import REPORTS, many

GOLDEN = ("broken_ouster_description", "husky_description")
HERE = "/home/user/work"
LINE = "      <resolution>0.1</resolution>"
PLACE = Place("model.sdf", 141, 19, 141, 22, "sdf/model[m]/link[l]", snippet=LINE)
FAULT = ReportedFinding(
    "SEN005",
    "lidar-scan-resolution",
    Severity.ERROR,
    Concern.INTERFACE,
    "scan resolution is 0.1, expected 1",
    "0123456789abcdef",
    (PLACE,),
    why="Rays are lost.",
    how="write 1.",
    title="A lidar with fewer rays than samples",
    source="SDFormat specification.",
)
PACKAGE = PackageReport("rover", "models/rover", "robot", (FAULT,))


def run_of(*packages: PackageReport, not_opened: tuple[NotOpened, ...] = ()) -> dict[str, Any]:
    report = Report(packages, {"subt-check": "1.0"}, not_opened)
    (run,) = json.loads(to_sarif(report, HERE))["runs"]
    return dict(run)


def result_of(**changes: Any) -> dict[str, Any]:
    (result,) = run_of(replace(PACKAGE, findings=(replace(FAULT, **changes),)))["results"]
    return dict(result)


def uri_of(place: Place, path: str = "models/rover") -> dict[str, str]:
    package = replace(PACKAGE, path=path, findings=(replace(FAULT, places=(place,)),))
    (result,) = run_of(package)["results"]
    return dict(result["locations"][0]["physicalLocation"]["artifactLocation"])


def checked(written: str, sarif: jsonschema.Draft7Validator) -> dict[str, Any]:
    """Return a valid log whose indices and marks fit each other."""
    assert written.isascii()
    log = json.loads(written)
    sarif.validate(log)
    (run,) = log["runs"]
    rules = [rule["id"] for rule in run["tool"]["driver"]["rules"]]
    assert len(set(rules)) == len(rules)
    for result in run["results"]:
        assert rules[result["ruleIndex"]] == result["ruleId"]
    for mark in ("suppressions", "baselineState"):
        assert len({mark in result for result in run["results"]}) <= 1
    return dict(log)


def test_a_finding_is_a_result_with_place_text_and_fingerprint() -> None:
    result = result_of()
    assert result["ruleId"] == "SEN005"
    assert result["level"] == "error"
    assert result["message"] == {"text": "scan resolution is 0.1, expected 1"}
    assert result["partialFingerprints"] == {"subtCheck/v1": "0123456789abcdef"}
    (location,) = result["locations"]
    assert location["physicalLocation"] == {
        "artifactLocation": {"uri": "models/rover/model.sdf", "uriBaseId": "%SRCROOT%"},
        "region": {
            "startLine": 141,
            "startColumn": 19,
            "endLine": 141,
            "endColumn": 22,
            "snippet": {"text": "0.1"},
        },
        "contextRegion": {
            "startLine": 141,
            "startColumn": 1,
            "endLine": 141,
            "endColumn": len(LINE) + 1,
            "snippet": {"text": LINE},
        },
    }
    assert location["logicalLocations"][0]["fullyQualifiedName"] == "sdf/model[m]/link[l]"
    assert result_of(severity=Severity.INFO)["level"] == "note"


def test_the_page_of_a_rule_that_found_something_is_carried_along() -> None:
    (rule,) = run_of(replace(PACKAGE, findings=(FAULT, FAULT)))["tool"]["driver"]["rules"]
    assert rule["name"] == "LidarScanResolution"
    assert rule["shortDescription"] == {"text": "A lidar with fewer rays than samples"}
    assert rule["fullDescription"] == {"text": "Rays are lost."}
    assert rule["help"]["text"].splitlines()[::2] == [
        "Rays are lost.",
        "Fix: write 1.",
        "Source: SDFormat specification.",
        "subt-check rule SEN005",
    ]
    assert rule["helpUri"].endswith("/rules/SEN005.html")
    assert rule["defaultConfiguration"] == {"level": "error"}
    assert rule["properties"] == {"tags": ["SEN", "interface"]}


def test_paths_are_relative_to_where_the_command_was_run() -> None:
    base = "%SRCROOT%"
    sibling = replace(PLACE, file="../other/a b%.sdf")
    assert uri_of(sibling) == {"uri": "models/other/a%20b%25.sdf", "uriBaseId": base}
    assert uri_of(PLACE, "./x/../rover") == {"uri": "rover/model.sdf", "uriBaseId": base}
    assert uri_of(PLACE, f"{HERE}/rover") == {"uri": "rover/model.sdf", "uriBaseId": base}
    assert uri_of(PLACE, "../rover") == {"uri": "file:///home/user/rover/model.sdf"}
    assert uri_of(Place("")) == {"uri": "models/rover/", "uriBaseId": base}
    assert uri_of(Place(""), ".") == {"uri": "./", "uriBaseId": base}
    assert uri_of(Place("\udcff.sdf")) == {"uri": "models/rover/%FF.sdf", "uriBaseId": base}


NAMES = st.text(st.characters(exclude_characters="/\0", exclude_categories=["Cs"]), min_size=1)


@given(st.lists(NAMES, min_size=1))
def test_a_path_can_be_read_back_from_its_address(parts: list[str]) -> None:
    path = "/".join(parts)
    found = artifact(path, "/")
    base = "/" if "uriBaseId" in found else ""
    steps: list[str] = []
    for part in parts:
        if part == "..":
            steps = steps[:-1]
        elif part != ".":
            steps.append(part)
    assert base + unquote(found["uri"].removeprefix("./")) == "/" + "/".join(steps)


def test_a_stretch_has_its_text_where_the_report_has_it() -> None:
    assert region(Place("a", 3, 1, 3, 1)) == region(Place("a", 3)) == {"startLine": 3}
    assert "snippet" not in region(replace(PLACE, end_line=142))
    assert "snippet" not in region(replace(PLACE, end_column=300))
    assert region(replace(PLACE, column=1, end_column=3))["snippet"] == {"text": "  "}


def test_further_places_are_related_locations() -> None:
    note = replace(PLACE, line=9, end_line=9, note="the first of that name")
    result = result_of(places=(PLACE, note, replace(PLACE, line=8, end_line=8)))
    related = result["relatedLocations"]
    assert [each["message"]["text"] for each in related] == [note.note, "also here"]
    assert result["occurrenceCount"] == 2
    many = tuple(replace(PLACE, line=line, end_line=line) for line in range(1, 501))
    assert len(result_of(places=many)["relatedLocations"]) == 100


def test_a_message_holds_no_link() -> None:
    assert result_of(message="link '[a](0)'")["message"]["text"] == "link '[a] (0)'"


def test_a_fix_says_what_to_put_where() -> None:
    other = replace(PLACE, file="../other/model.sdf")
    edits = (Edit(PLACE, "1", "0.1"), Edit(other, "1\n", "0.1"))
    (fix,) = result_of(fix=Fix(Safety.UNSAFE, edits))["fixes"]
    assert fix["description"] == {"text": "write 1."}
    assert fix["properties"] == {"safety": "unsafe"}
    first, second = fix["artifactChanges"]
    assert first["artifactLocation"]["uri"] == "models/rover/model.sdf"
    assert second["artifactLocation"]["uri"] == "models/other/model.sdf"
    assert second["replacements"] == [
        {
            "deletedRegion": {
                "startLine": 141,
                "startColumn": 19,
                "endLine": 141,
                "endColumn": 22,
            },
            "insertedContent": {"text": "1\n"},
        }
    ]
    assert "fixes" not in result_of(fix=Fix(Safety.SAFE, edits * EDITS_LIMIT))


def test_what_was_set_aside_stands_there_with_its_reason() -> None:
    comment = Suppressed(FAULT, SuppressedBy.COMMENT, "it is so", replace(PLACE, line=140))
    setting = Suppressed(FAULT, SuppressedBy.SETTINGS, "it must be so")
    counted, in_source, external = run_of(replace(PACKAGE, suppressed=(comment, setting)))[
        "results"
    ]
    assert counted["suppressions"] == []
    (said,) = in_source["suppressions"]
    assert (said["kind"], said["status"]) == ("inSource", "accepted")
    assert said["justification"] == "it is so"
    assert said["location"]["physicalLocation"]["region"]["startLine"] == 140
    (said,) = external["suppressions"]
    assert (said["kind"], said["justification"]) == ("external", "it must be so")
    assert "baselineState" not in counted


def test_what_is_in_the_baseline_is_unchanged_and_the_rest_new() -> None:
    known = Suppressed(FAULT, SuppressedBy.BASELINE, "in the baseline")
    results = run_of(replace(PACKAGE, suppressed=(known,)))["results"]
    assert [each["baselineState"] for each in results] == ["new", "unchanged"]
    assert "baselineState" not in result_of()


def test_what_could_not_be_looked_at_is_a_notification() -> None:
    unseen = (
        NotChecked("SEN001", "the model is not available", Cause.NOT_AT_HAND),
        NotChecked("SEN002", "switched off", Cause.SWITCHED_OFF),
        NotChecked("SEN003", "SEN003 could not run", Cause.CRASHED),
    )
    (invocation,) = run_of(replace(PACKAGE, not_checked=unseen))["invocations"]
    assert invocation["executionSuccessful"] is False
    said = invocation["toolExecutionNotifications"]
    assert [(each["level"], each["associatedRule"]["id"]) for each in said] == [
        ("error", "SEN003"),
        ("note", "SEN001"),
    ]
    (invocation,) = run_of(replace(PACKAGE, not_checked=unseen[:2]))["invocations"]
    assert invocation["executionSuccessful"] is True
    missing = NotOpened("nowhere", "does not exist", failed=True)
    (invocation,) = run_of(not_opened=(missing,))["invocations"]
    assert invocation["executionSuccessful"] is False


def test_a_finding_in_a_file_that_packages_share_is_one_result() -> None:
    foreign = replace(FAULT, places=(replace(PLACE, file="../base/model.sdf"),))
    one = replace(PACKAGE, findings=(foreign,))
    two = replace(one, name="rover2", path="models/rover2")
    base = replace(PACKAGE, name="base", path="models/base")
    assert len(run_of(one, two)["results"]) == 1
    (result,) = run_of(one, base, two)["results"]
    assert result["properties"]["package"] == "base"


def test_so_many_results_and_no_more() -> None:
    report = many(RESULTS_LIMIT + 7)
    (run,) = json.loads(to_sarif(report, HERE))["runs"]
    assert len(run["results"]) == RESULTS_LIMIT
    said = run["invocations"][0]["toolExecutionNotifications"]
    assert said[-1]["message"]["text"].startswith("7 results left out")


def test_samples_are_valid(of_samples: Report, sarif: jsonschema.Draft7Validator) -> None:
    written = to_sarif(of_samples, str(SAMPLES))
    log = checked(written, sarif)
    assert len(Sarif.model_validate_json(written).runs[0].results or []) > 200
    for result in log["runs"][0]["results"]:
        where = result["locations"][0]["physicalLocation"]["artifactLocation"]
        assert (SAMPLES / unquote(where["uri"])).exists()


def test_a_driven_sample_is_valid(of_a_trial: Report, sarif: jsonschema.Draft7Validator) -> None:
    checked(to_sarif(of_a_trial, str(SAMPLES)), sarif)


def test_the_corpus_is_valid(of_corpus: Report, sarif: jsonschema.Draft7Validator) -> None:
    checked(to_sarif(of_corpus, HERE), sarif)


@given(REPORTS)
def test_any_report_is_valid(sarif: jsonschema.Draft7Validator, report: Report) -> None:
    log = checked(to_sarif(report, HERE), sarif)
    said = json.dumps(log, ensure_ascii=False)
    assert not [each for each in said if "\ud800" <= each <= "\udfff"]


@pytest.mark.parametrize("name", GOLDEN)
def test_sarif_is_the_one_beside_the_sample(name: str, pytestconfig: pytest.Config) -> None:
    beside = SAMPLES / f"{name}.report.sarif"
    report = check_package(SAMPLES / name, Settings(trial=False))
    log = json.loads(to_sarif(replace(report, versions={}), str(SAMPLES)))
    (invocation,) = log["runs"][0]["invocations"]
    texts = [it["message"]["text"] for it in invocation["toolExecutionNotifications"]]
    # Whichever rules miss a part: a new one changes nothing.
    reasons = {re.sub(r"\w+(?= was not checked: )", "a rule", text) for text in texts}
    invocation["toolExecutionNotifications"] = sorted(reasons)
    if pytestconfig.getoption("--update-golden"):
        beside.write_text(json.dumps(log, indent=1, ensure_ascii=False) + "\n", "utf-8")
    assert log == json.loads(beside.read_text("utf-8"))
