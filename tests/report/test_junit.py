"""JUnit XML: valid by the schema of Jenkins, and read back as what was found."""

from __future__ import annotations

from hypothesis import given
from junitparser import JUnitXml, TestCase, TestSuite
from lxml import etree
from msgspec.structs import replace

from checker.finding import Place, Severity
from checker.report.ci_formats import FINDINGS_LIMIT, to_junit
from checker.report.report import Cause, NotChecked, NotOpened, PackageReport, Report
from tests.report.any_report import REPORTS, many

(PACKAGE,) = many(2).packages
ERROR = PACKAGE.findings[0]
WARNING = replace(ERROR, rule="GEO001", severity=Severity.WARNING, message="it floats")
UNSEEN = NotChecked("SEN001", "the model is not available", Cause.NOT_AT_HAND)


def suite_of(package: PackageReport) -> TestSuite:
    (suite,) = JUnitXml.fromstring(to_junit(Report((package,), {})).encode())
    return suite


def case_of(package: PackageReport, rule: str) -> TestCase:
    (case,) = (case for case in suite_of(package) if case.name == rule)
    return case


def test_each_rule_that_looked_is_a_case() -> None:
    suite = suite_of(replace(PACKAGE, looked=("SDF001", "SDF004"), timings={"rules": 0.25}))
    assert (suite.name, suite.tests, suite.failures, suite.time) == ("rover", 2, 1, 0.25)
    assert [(case.name, case.classname, case.is_passed) for case in suite] == [
        ("SDF001", "rover", True),
        ("SDF004", "rover", False),
    ]


def test_what_fails_the_run_is_a_failure() -> None:
    (failure,) = case_of(PACKAGE, "SDF004").result
    assert failure.message.startswith("element 0 ")
    assert failure.message.endswith(" (and 1 more)")
    assert failure.type == "error unknown-element"
    first, second, *others = failure.text.splitlines()
    assert first.startswith("models/rover/model.sdf:1:1 error SDF004 unknown-element: element 0 ")
    assert second.startswith("models/rover/model.sdf:2:1 ")
    assert others == ["why: It is ignored.", "fix: take it out.", "subt-check rule SDF004"]


def test_a_lesser_finding_is_told_unless_it_fails_the_run() -> None:
    package = replace(PACKAGE, findings=(WARNING,))
    passed = case_of(package, "GEO001")
    assert passed.is_passed
    assert "warning GEO001 unknown-element: it floats" in str(passed.system_out)
    strict = case_of(replace(package, fail_on=Severity.WARNING), "GEO001")
    assert strict.is_failure


def test_what_was_not_checked_is_skipped_and_a_crash_is_an_error() -> None:
    case = case_of(replace(PACKAGE, not_checked=(UNSEEN,), looked=("SEN001",)), "SEN001")
    assert case.is_skipped
    assert case.result[0].message == "the model is not available"
    crash = NotChecked("SEN002", "SEN002 could not run", Cause.CRASHED)
    assert case_of(replace(PACKAGE, not_checked=(crash,)), "SEN002").is_error


def test_a_rule_that_found_something_and_could_not_see_the_rest_fails() -> None:
    unseen = replace(UNSEEN, rule="SDF004")
    case = case_of(replace(PACKAGE, not_checked=(unseen,)), "SDF004")
    assert case.is_failure
    assert "not checked: the model is not available" in str(case.system_out)


def test_an_input_that_was_not_opened_is_an_error() -> None:
    missing = NotOpened("nowhere", "does not exist", failed=True)
    (suite,) = JUnitXml.fromstring(to_junit(Report((), {}, (missing,))).encode())
    assert (suite.name, suite.errors) == ("nowhere", 1)


def test_findings_of_one_rule_are_bounded() -> None:
    (failure,) = case_of(many(10_000).packages[0], "SDF004").result
    assert failure.text.count("SDF004 unknown-element") == FINDINGS_LIMIT
    assert "… and 9900 more findings" in failure.text


def test_a_fault_of_the_folder_has_no_line() -> None:
    package = replace(PACKAGE, findings=(replace(ERROR, places=(Place(""),)),))
    (failure,) = case_of(package, "SDF004").result
    assert failure.text.startswith("models/rover/ error ")


def test_samples_are_valid(of_samples: Report, junit: etree.XMLSchema) -> None:
    written = to_junit(of_samples).encode()
    junit.assertValid(etree.fromstring(written))
    for package, suite in zip(of_samples.packages, JUnitXml.fromstring(written), strict=True):
        failing = {each.rule for each in package.findings if each.severity is Severity.ERROR}
        assert suite.name == package.name
        assert suite.failures == len(failing)
        assert suite.tests > 30


def test_the_corpus_is_valid(of_corpus: Report, junit: etree.XMLSchema) -> None:
    junit.assertValid(etree.fromstring(to_junit(of_corpus).encode()))


@given(REPORTS)
def test_any_report_is_valid(junit: etree.XMLSchema, report: Report) -> None:
    written = to_junit(report)
    junit.assertValid(etree.fromstring(written.encode()))
