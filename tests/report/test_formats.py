"""Every format takes every report, and the command writes it where it is asked to."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest
from hypothesis import given
from msgspec import to_builtins
from msgspec.structs import replace

from checker import cli
from checker.base.output import EXIT_CLEAN, EXIT_FINDINGS
from checker.cli import arguments
from checker.engine.report_cache import from_stored
from checker.report.formats import FORMATS
from checker.report.render_settings import Palette, RenderSettings
from checker.report.report import Report
from checker.report.text_report import SHOWN_LIMIT
from tests.conftest import SAMPLES
from tests.report.any_report import REPORTS, many
from tests.test_samples import SCHEMA

GOOD, BROKEN = "my_gurdy_description", "broken_gurdy_description"
MANNER = RenderSettings(Palette(enabled=False), str(SAMPLES))


def test_the_command_offers_every_format() -> None:
    assert tuple(FORMATS) == arguments.FORMAT_NAMES


@pytest.mark.slow
@pytest.mark.parametrize("form", FORMATS)
def test_every_format_tells_of_every_sample(form: str, of_samples: Report) -> None:
    written = FORMATS[form](of_samples, MANNER)
    for package in of_samples.packages:
        assert package.name in written.replace("&#95;", "_")


@pytest.mark.parametrize("form", FORMATS)
def test_every_format_takes_a_run_that_checked_nothing(form: str) -> None:
    assert isinstance(FORMATS[form](Report((), {}), MANNER), str)


@pytest.mark.parametrize("form", sorted(set(FORMATS) - {"html"}))
def test_a_file_of_a_sibling_has_its_own_path(form: str) -> None:
    report = many(1)
    place = replace(report.packages[0].findings[0].places[0], file="../other/model.sdf")
    finding = replace(report.packages[0].findings[0], places=(place,))
    package = replace(report.packages[0], findings=(finding,))
    written = FORMATS[form](replace(report, packages=(package,)), MANNER)
    assert ("../other/model.sdf" if form == "json" else "models/other/model.sdf") in written


@pytest.mark.parametrize("form", sorted(set(FORMATS) - {"text", "concise"}))
def test_the_command_prints_a_format(
    form: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(SAMPLES)
    code = cli.main([BROKEN, "--no-trial", "--format", form])
    printed = capsys.readouterr().out
    assert code == EXIT_FINDINGS
    starts = {"json": "{", "sarif": "{", "github": "::error file=", "junit": "<?xml"}
    assert printed.startswith(starts.get(form, "<!doctype html" if form == "html" else "## "))


def test_the_report_folder_holds_what_programs_read(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(SAMPLES)
    code = cli.main([GOOD, "--no-trial", "--report", str(tmp_path / "out")])
    assert code == EXIT_CLEAN
    page = tmp_path / "out/report.html"
    assert capsys.readouterr().out.endswith(f"(trial not run)\nreport: {page}\n")
    as_json = json.loads((tmp_path / "out/report.json").read_text("utf-8"))
    as_sarif = json.loads((tmp_path / "out/report.sarif").read_text("utf-8"))
    assert as_json["packages"][0]["name"] == GOOD
    assert as_sarif["version"] == "2.1.0"


def test_the_report_opens_in_the_browser(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    monkeypatch.chdir(SAMPLES)
    cli.main([GOOD, "--no-trial", "--report", str(tmp_path), "--open", "--format", "json"])
    assert opened == [(tmp_path / "report.html").as_uri()]
    printed = capsys.readouterr()
    assert json.loads(printed.out)["packages"]
    assert printed.err.endswith(f"report: {tmp_path / 'report.html'}\n")


def test_statistics_follow_the_text_and_spoil_no_other_format(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(SAMPLES)
    cli.main([BROKEN, "--no-trial", "--statistics"])
    assert "\n\nrule    severity  findings  packages  name\n" in capsys.readouterr().out
    cli.main([BROKEN, "--no-trial", "--statistics", "--format", "json"])
    printed = capsys.readouterr()
    assert json.loads(printed.out)["packages"]
    assert "rule    severity" in printed.err


def test_text_shows_so_many_findings_and_counts_the_rest() -> None:
    written = FORMATS["text"](many(10_000), MANNER)
    assert written.count(" error SDF004 ") == SHOWN_LIMIT
    assert "… and 9800 more findings: 9800 SDF004; --format json lists all\n" in written
    assert "more finding" not in FORMATS["text"](many(SHOWN_LIMIT), MANNER)


@given(REPORTS)
def test_json_of_any_report_is_valid(report: Report) -> None:
    written = json.loads(FORMATS["json"](report, MANNER))
    jsonschema.validate(written, SCHEMA)
    for package, said in zip(report.packages, written["packages"], strict=True):
        assert [each["by"] for each in said["suppressed"]] == [s.by for s in package.suppressed]


@given(REPORTS)
def test_any_report_can_be_kept_and_read_back(report: Report) -> None:
    for package in report.packages:
        kept = json.loads(json.dumps(to_builtins(package)))
        assert from_stored(kept, package.path) == package


def test_json_lists_all() -> None:
    written = json.loads(FORMATS["json"](many(10_000), MANNER))
    assert len(written["packages"][0]["findings"]) == 10_000
