"""A JSON report read back is the report that was written, as far as JSON holds it."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.finding import Edit, Fix
from checker.report import json_report
from checker.report.formats import FORMATS
from checker.report.json_report import NoReport, report_from_json, to_json
from checker.report.render_settings import Palette, RenderSettings
from checker.report.report import PackageReport, Report, ReportedFinding
from tests.conftest import SAMPLES
from tests.report.any_report import REPORTS, many
from tests.test_samples import NAMES

MANNER = RenderSettings(Palette(enabled=False), "/home/ann")
IN_WORDS = ("text", "github", "markdown")
HOSTILE = "\x1b]0;owned\x07"


def in_json(finding: ReportedFinding) -> ReportedFinding:
    """Return what JSON holds of a finding."""
    fix = finding.fix
    if fix is not None:
        fix = Fix(fix.safety, tuple(_edit_in_json(edit) for edit in fix.edits))
    return replace(finding, fix=fix, why="", how="", key="", title="", source="", name="a-fault")


def _edit_in_json(edit: Edit) -> Edit:
    place = replace(edit.place, element="", note="")
    return Edit(place, edit.replacement, "")


def package_in_json(package: PackageReport) -> PackageReport:
    return replace(
        package,
        findings=tuple(map(in_json, package.findings)),
        suppressed=tuple(replace(s, finding=in_json(s.finding)) for s in package.suppressed),
        display=None,
        patch="",
        looked=(),
    )


def held(report: Report) -> Report:
    return replace(report, packages=tuple(map(package_in_json, report.packages)))


@given(REPORTS.map(held))
def test_any_report_is_read_back(report: Report) -> None:
    written = to_json(report)
    again = report_from_json(written)
    assert again == report
    assert to_json(again) == written


@pytest.mark.parametrize("name", NAMES)
def test_the_report_beside_a_sample_is_read_back(name: str) -> None:
    said = json.loads((SAMPLES / f"{name}.report.json").read_text("utf-8"))
    said["tool"]["versions"] = {}
    for package in said["packages"]:
        package["timings"] = {}
        del package["missing"]
        for trial in filter(None, (package["trial"], *package["other_trials"])):
            trial["series"] = {each: [] for each in trial["series"]}
    assert json.loads(to_json(report_from_json(json.dumps(said)))) == said


@pytest.mark.slow
def test_reports_of_samples_read_back_are_told_the_same(of_samples: Report) -> None:
    again = report_from_json(to_json(of_samples))
    bare = held(of_samples)
    named = [
        replace(package, findings=tuple(map(_with_name, package.findings, told.findings)))
        for package, told in zip(bare.packages, of_samples.packages, strict=True)
    ]
    expected = replace(of_samples, packages=tuple(named))
    assert any(package.findings for package in again.packages)
    for form in IN_WORDS:
        assert FORMATS[form](again, MANNER) == FORMATS[form](expected, MANNER)


def _with_name(finding: ReportedFinding, told: ReportedFinding) -> ReportedFinding:
    return replace(finding, name=told.name)


def test_a_trial_read_back_is_told_the_same(of_a_trial: Report) -> None:
    again = report_from_json(to_json(of_a_trial))
    assert to_json(again) == to_json(of_a_trial)
    assert FORMATS["text"](again, MANNER) == FORMATS["text"](of_a_trial, MANNER)


@pytest.mark.slow
def test_ten_thousand_findings_are_read() -> None:
    written = to_json(many(10_000))
    assert len(written) < json_report.SIZE_LIMIT
    assert to_json(report_from_json(written)) == written


def changed(change: Callable[[dict[str, Any]], object]) -> str:
    said = json.loads(to_json(many(2)))
    change(said)
    return json.dumps(said)


def driven(**figure: Any) -> dict[str, Any]:
    """Return a trial with one figure."""
    texts = dict.fromkeys(("name", "label", "unit", "part", "other", "rule"), "a")
    measured = {**texts, "value": 1.0, "limits": {}, "verdict": "error"} | figure
    lists: dict[str, Any] = {name: [] for name in ("course", "repairs", "notes", "trouble")}
    words = dict.fromkeys(("drive", "refused", "refused_part"), "")
    return {**lists, **words, "versions": {}, "series": {}, "measurements": [measured]}


def test_a_figure_of_a_trial_is_read() -> None:
    said = changed(lambda said: said["packages"][0].update(trial=driven()))
    assert report_from_json(said).packages[0].trial == driven()


def first(said: dict[str, Any]) -> Any:
    return said["packages"][0]["findings"][0]


def test_additions_of_later_versions_are_passed_over() -> None:
    def add(said: dict[str, Any]) -> None:
        for each in (said, said["tool"], said["packages"][0], first(said)):
            each["mood"] = {"of": ["the", 3]}
        said["packages"][0]["facts"] = {"mood": {"of": []}, "links": 3}
        first(said)["places"][0]["mood"] = None

    package = report_from_json(changed(add)).packages[0]
    assert package.facts == {"links": 3}
    assert len(package.findings) == 2


def test_what_a_page_of_a_rule_says_is_not_taken_from_elsewhere() -> None:
    said = changed(lambda said: first(said).update(why=HOSTILE, how=HOSTILE))
    finding = report_from_json(said).packages[0].findings[0]
    assert (finding.why, finding.how) == ("", "")


def test_members_that_came_later_may_be_missing() -> None:
    def remove(said: dict[str, Any]) -> None:
        del said["packages"][0]["fail_on"]
        said["not_opened"] = [{"path": "a", "reason": "b"}]

    report = report_from_json(changed(remove))
    assert report.packages[0].fail_on == "error"
    assert not report.not_opened[0].failed


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "is not JSON"),
        ("<html>", "is not JSON"),
        ("[" * 100_000, "is not JSON"),
        ('{"schema_version": ' + "9" * 5000 + "}", "is not JSON"),
        ("null", "schema_version is None"),
        ("{}", "schema_version is None"),
        ('{"schema_version": "2"}', "schema_version is '2', expected '1'"),
        ('{"schema_version": 1}', "schema_version is 1, expected '1'"),
        ('{"schema_version": "1"}', "missing required"),
    ],
)
def test_what_is_no_report_is_refused(text: str, said: str) -> None:
    with pytest.raises(NoReport, match=said):
        report_from_json(text)


@pytest.mark.parametrize(
    "change",
    [
        lambda said: said.update(packages={}),
        lambda said: said["packages"].append(None),
        lambda said: said["packages"][0].update(name=3),
        lambda said: said["packages"][0].update(kind=HOSTILE),
        lambda said: said["packages"][0].update(profile=HOSTILE),
        lambda said: said["packages"][0].update(fail_on="never"),
        lambda said: said["packages"][0].update(trial={"drive": "none"}),
        lambda said: said["packages"][0].update(timings={"open": "long"}),
        lambda said: said["packages"][0].update(trial=driven(limits={HOSTILE: 1})),
        lambda said: said["packages"][0].update(trial=driven(verdict="good")),
        lambda said: first(said).update(rule=HOSTILE),
        lambda said: first(said).update(name=HOSTILE),
        lambda said: first(said).update(severity="grave"),
        lambda said: first(said).update(places=[]),
        lambda said: first(said).update(fix=[]),
        lambda said: first(said)["places"][0].update(line=0),
        lambda said: first(said)["places"][0].update(column=-5),
        lambda said: first(said)["places"][0].update(end_column=2**62),
        lambda said: first(said)["places"][0].update(line=True),
        lambda said: first(said)["places"][0].update(line=1.5),
        lambda said: first(said)["places"][0].update(snippet=None),
    ],
)
def test_a_report_with_a_member_of_another_kind_is_refused(
    change: Callable[[dict[str, Any]], object],
) -> None:
    with pytest.raises(NoReport, match=r"the report is invalid: (Expected|Object missing|Invalid)"):
        report_from_json(changed(change))


def test_a_report_beyond_all_bounds_is_refused() -> None:
    with pytest.raises(NoReport, match="more than 128 million characters"):
        report_from_json(" " * (json_report.SIZE_LIMIT + 1))


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=5,
)


def members(said: Any) -> Iterator[tuple[Any, Any]]:
    """Yield each member of each object and list, as its container and its key."""
    for key in list(said) if isinstance(said, dict) else range(len(said)):
        yield said, key
        if isinstance(said[key], dict | list):
            yield from members(said[key])


@given(st.data())
def test_a_report_spoilt_anywhere_is_refused_or_can_be_shown(
    of_a_trial: Report, data: st.DataObject
) -> None:
    said = json.loads(to_json(replace(of_a_trial, packages=(shortened(of_a_trial),))))
    container, key = data.draw(st.sampled_from(list(members(said))))
    container[key] = data.draw(JSON)
    try:
        report = report_from_json(json.dumps(said))
    except NoReport:
        return
    for form in ("text", "github", "junit", "markdown", "sarif", "json"):
        assert "\x1b" not in FORMATS[form](report, MANNER)


def shortened(report: Report) -> PackageReport:
    """Return a driven package with a finding and without long series."""
    package = report.packages[0]
    assert package.trial is not None
    series = {name: values[:2] for name, values in package.trial["series"].items()}
    findings = many(1).packages[0].findings
    return replace(package, findings=findings, trial={**package.trial, "series": series})
