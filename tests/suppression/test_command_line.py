"""What is set aside, as the command shows it, and how the command ends."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from checker.cli import main
from checker.finding import Concern, Place, Severity
from checker.report.report import IN_BASELINE, ReportedFinding, Suppressed, SuppressedBy
from checker.report.text_report import suppressed_text
from checker.rule_testing import write_example
from checker.rulebook.example_files import NAME
from tests.suppression.stage import TYRE, axle, ignore

CHOSEN = ("--no-trial", "--select", "CFG,KIN001")
FILE = "subt-check-baseline.json"


@pytest.fixture
def rover(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package with a fault, in the folder where the command is run."""
    monkeypatch.chdir(tmp_path)
    return write_example(axle(), tmp_path)


def mend(package: Path, child: str) -> None:
    model = package / "model.sdf"
    model.write_text(model.read_text("utf-8").replace(TYRE, child), "utf-8")


def test_the_verdict_and_the_exit_code_count_what_is_left(
    rover: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([NAME, *CHOSEN]) == 1
    capsys.readouterr()
    mend(rover, f"{ignore('KIN001')} {TYRE}")
    assert main([NAME, *CHOSEN]) == 0
    shown = capsys.readouterr().out.splitlines()
    assert "suppressed: 1 finding of KIN001 by a comment: it is so" in shown
    assert shown[-1] == f"{NAME}: Ready: nothing to fix (1 suppressed, 1 of them an error)"


def test_a_baseline_is_written_and_holds(rover: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([NAME, *CHOSEN, "--write-baseline"]) == 0
    assert capsys.readouterr().out == f"{FILE} contains 1 finding of 1 package\n"
    chosen = [NAME, *CHOSEN, "--baseline", FILE]
    assert main(chosen) == 0
    assert "suppressed: 1 finding by the baseline\n" in capsys.readouterr().out
    mend(rover, f"\n\n{TYRE}<!-- moved -->")
    assert main(chosen) == 0
    mend(rover, f"{TYRE}</joint>{axle('<child>ghost</child>', 'spare')[:-10]}")
    assert main(chosen) == 1
    assert "joint 'spare' has child 'ghost'" in capsys.readouterr().out


def test_what_is_mended_is_asked_to_be_taken_out(
    rover: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main([NAME, *CHOSEN, "--write-baseline"])
    mend(rover, "<child>base_link</child>")
    assert main([NAME, *CHOSEN, "--baseline", FILE, "--info"]) == 0
    assert "info CFG004 stale-baseline-entry" in capsys.readouterr().out
    assert main([NAME, *CHOSEN, "--write-baseline"]) == 0
    assert json.loads(Path(FILE).read_text("utf-8"))["packages"] == {NAME: []}


def test_writing_anew_keeps_reasons_and_what_was_not_checked(rover: Path) -> None:
    main([str(rover), *CHOSEN, "--write-baseline", "--baseline", "b.json"])
    content = json.loads(Path("b.json").read_text("utf-8"))
    (entry,) = content["packages"][NAME]
    entry["reason"] = "next year"
    unseen = {**entry, "rule": "GEO001", "message": "not checked"}
    gone = {**entry, "rule": "OLD001", "message": "no rule any more"}
    content["packages"] = {NAME: [entry, unseen, gone], "other": [unseen]}
    Path("b.json").write_text(json.dumps(content), "utf-8")
    main([NAME, *CHOSEN, "--write-baseline", "--baseline", "b.json"])
    after = json.loads(Path("b.json").read_text("utf-8"))["packages"]
    assert after == {NAME: [entry, unseen], "other": [unseen]}


def test_a_baseline_wins_over_the_one_of_the_settings(rover: Path) -> None:
    (rover / "subt-check.toml").write_text('baseline = "none.json"\n', "utf-8")
    assert main([NAME, *CHOSEN]) == 2
    assert main([NAME, *CHOSEN, "--write-baseline", "--baseline", FILE]) == 0
    assert main([NAME, *CHOSEN, "--baseline", FILE]) == 0


def test_the_file_that_the_settings_name_is_written(
    rover: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (rover / "subt-check.toml").write_text('baseline = "own.json"\n', "utf-8")
    assert main([NAME, *CHOSEN, "--write-baseline"]) == 0
    assert capsys.readouterr().out == f"{NAME}/own.json contains 1 finding of 1 package\n"
    assert main([NAME, *CHOSEN]) == 0
    assert main([NAME, *CHOSEN, "--write-baseline"]) == 0


def test_where_settings_name_different_files_the_usual_one_is_written(rover: Path) -> None:
    (rover / "subt-check.toml").write_text('baseline = "own.json"\n', "utf-8")
    write_example({"@fragment": axle(), "@name": "other_rover_sensor_config_1"}, Path.cwd())
    assert main([".", *CHOSEN, "--write-baseline"]) == 0
    assert not (rover / "own.json").exists()
    assert len(json.loads(Path(FILE).read_text("utf-8"))["packages"]) == 2


def test_no_file_in_an_archive_is_written(rover: Path) -> None:
    (rover / "subt-check.toml").write_text('baseline = "own.json"\n', "utf-8")
    shutil.make_archive("packed", "zip", ".", NAME)
    assert main(["packed.zip", *CHOSEN, "--write-baseline"]) == 0
    assert NAME in json.loads(Path(FILE).read_text("utf-8"))["packages"]


def test_packages_of_one_name_are_refused(rover: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(rover, f"other/{NAME}")
    assert main([NAME, f"other/{NAME}", *CHOSEN, "--write-baseline"]) == 2
    said = f"subt-check: {NAME} and other/{NAME} are packages with the same name, {NAME}, which a "
    assert capsys.readouterr().err.startswith(said)
    assert not Path(FILE).exists()


def test_what_another_package_has_in_the_baseline_is_not_asked_about(
    rover: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main([NAME, *CHOSEN, "--write-baseline"])
    mend(rover, "<child>base_link</child>")
    rover.rename("other_rover_sensor_config_1")
    assert main(["other_rover_sensor_config_1", *CHOSEN, "--baseline", FILE]) == 0
    assert "CFG004" not in capsys.readouterr().out


def test_a_replaced_place_is_reported(rover: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """KIN001 says the same of both joints, and one takes the place of the other."""
    main([NAME, *CHOSEN, "--write-baseline"])
    model = rover / "model.sdf"
    model.write_text(model.read_text("utf-8").replace('"axle"', '"spare"'), "utf-8")
    capsys.readouterr()
    assert main([NAME, *CHOSEN, "--baseline", FILE]) == 1
    assert "joint 'spare' has child 'tyre'" in capsys.readouterr().out


@pytest.mark.parametrize("content", ["", "{}", '{"version": 9}', "<sdf/>"])
def test_another_file_is_neither_read_nor_overwritten(
    rover: Path, content: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("b.json").write_text(content, "utf-8")
    assert main([NAME, *CHOSEN, "--baseline", "b.json"]) == 2
    assert main([str(rover), *CHOSEN, "--baseline", "b.json", "--write-baseline"]) == 2
    assert "b.json: is not a baseline" in capsys.readouterr().err
    assert Path("b.json").read_text("utf-8") == content


def test_a_baseline_that_is_not_there(rover: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(rover), *CHOSEN, "--baseline", "none.json"]) == 2
    assert "none.json: does not exist; create it with --write-baseline" in capsys.readouterr().err


def test_nothing_is_remembered_across_baselines(
    rover: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Reports are kept by all that they depend on, the content of the baseline too."""
    assert main([str(rover), *CHOSEN, "--write-baseline"]) == 0
    assert main([NAME, *CHOSEN, "--baseline", FILE]) == 0
    Path(FILE).write_text('{"version": 2, "packages": {}}', "utf-8")
    assert main([NAME, *CHOSEN, "--baseline", FILE]) == 1
    capsys.readouterr()


def test_what_could_not_be_opened_or_checked_still_decides(rover: Path) -> None:
    assert main([str(rover), "nowhere", *CHOSEN, "--write-baseline"]) == 2


@pytest.mark.parametrize("kept", ["a comment", "settings", "the baseline"])
def test_what_is_set_aside_is_not_fixed(
    kept: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    comment = ignore("SEN005") if kept == "a comment" else ""
    scan = f"<scan><horizontal><resolution>0.1</resolution>{comment}</horizontal></scan>"
    lidar = f'<sensor name="lidar" type="gpu_lidar"><lidar>{scan}</lidar></sensor>'
    package = write_example(lidar, tmp_path)
    file = str(tmp_path / "b.json")
    chosen = [str(package), "--no-trial", "--select", "SEN005"]
    if kept == "settings":
        entry = '[[suppress]]\nrule = "SEN005"\nreason = "it is so"\n'
        (package / "subt-check.toml").write_text(entry, "utf-8")
    if kept == "the baseline":
        main([*chosen, "--write-baseline", "--baseline", file])
        chosen += ["--baseline", file]
    before = (package / "model.sdf").read_bytes()
    assert main([*chosen, "--fix"]) == 0
    assert (package / "model.sdf").read_bytes() == before
    assert f"by {kept}" in capsys.readouterr().out


def suppressed(rule: str, reason: str) -> Suppressed:
    place = (Place("model.sdf"),)
    found = ReportedFinding(rule, "name", Severity.ERROR, Concern.ROBOT, "message", "0", place)
    by = SuppressedBy.BASELINE if reason == IN_BASELINE else SuppressedBy.SETTINGS
    return Suppressed(found, by, reason)


def test_lines_are_counted_and_bounded() -> None:
    many = [suppressed("SEN005", f"reason {number}") for number in range(30)]
    lines = list(suppressed_text([*many, suppressed("SEN005", "reason 7"), *many[:2]]))
    assert len(lines) == 21
    assert lines[0].startswith("suppressed: 2 findings of SEN005 by settings: reason ")
    assert lines[-1] == "suppressed: 10 more findings"
    both = [suppressed("SEN005", IN_BASELINE), suppressed("KIN001", IN_BASELINE)]
    assert list(suppressed_text(both)) == ["suppressed: 2 findings by the baseline"]


def test_reasons_cannot_steer_a_terminal() -> None:
    (line,) = suppressed_text([suppressed("SEN005", "\x1b[2J\u202e" + "x" * 10_000)])
    assert "\x1b" not in line
    assert "\u202e" not in line
    assert len(line) < 400
