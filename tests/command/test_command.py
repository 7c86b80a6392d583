"""What the command prints, where, and how it ends."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from checker.cli import main
from checker.rule import Rule
from checker.rulebook.discovery import all_rules
from tests.command.conftest import BROKEN, GOOD, Run, clean_environment
from tests.each import of_each
from tests.test_samples import SCHEMA

CRASHING = """
from checker.rule import Concern, rule, Severity
from checker.package.package import Package
@rule("CRA001", "crash", Severity.ERROR, Concern.ROBOT)
def check(package: Package):
    raise ValueError("on purpose")
    yield
"""


@pytest.fixture
def with_crash(tmp_path: Path) -> dict[str, str]:
    """An environment in which another distribution's rule crashes."""
    site = tmp_path / "site"
    about = site / "crash_rules-1.0.dist-info"
    about.mkdir(parents=True)
    (site / "crash_rules.py").write_text(CRASHING)
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: crash-rules\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text("[subt_check.rules]\ncrash = crash_rules\n")
    return {"PYTHONPATH": str(site)}


def packages(text: str) -> list[dict[str, Any]]:
    """Return the packages of a JSON report without their timings."""
    report = json.loads(text)
    jsonschema.validate(report, SCHEMA)
    for package in report["packages"]:
        del package["timings"]
    return list(report["packages"])


def test_exit_0_when_there_is_nothing_to_mend(run_apart: Run, good: Path) -> None:
    done = run_apart(good.name)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.endswith(f"{GOOD}: Ready: nothing to fix\n")


def test_exit_1_when_there_is_an_error(run: Run, broken: Path) -> None:
    done = run("check", broken.name)
    assert (done.returncode, done.stderr) == (1, "")
    assert f"{BROKEN}/model.sdf:39:18 error REF001 absolute-uri: " in done.stdout
    assert f"\n{BROKEN}: Not ready: " in done.stdout
    assert " explains a rule, `--full` shows source lines and reasons\n" in done.stdout


def test_exit_1_for_a_warning_only_when_asked_for(run: Run, rover: Path) -> None:
    (rover / "launch/example.ign").unlink()
    assert run(rover, "--select", "PKG003").returncode == 0
    assert run(rover, "--select", "PKG003", "--fail-on", "warning").returncode == 1


def test_exit_3_when_a_rule_crashes(run_apart: Run, good: Path, with_crash: dict[str, str]) -> None:
    done = run_apart(good, **with_crash)
    assert done.returncode == 3
    assert "CRA001 could not run (ValueError: on purpose); please report this" in done.stdout
    assert f"{GOOD}: Incomplete: no error, but 1 rule for errors could not run" in done.stdout


@pytest.mark.slow
def test_unreadable_input_counts_more_than_a_crash_and_that_more_than_findings(
    run_apart: Run, good: Path, broken: Path, with_crash: dict[str, str]
) -> None:
    assert run_apart(good, broken).returncode == 1
    assert run_apart(good, broken, **with_crash).returncode == 3
    assert run_apart(good, broken, "nowhere", **with_crash).returncode == 2


def test_one_bad_path_does_not_keep_the_others_from_being_checked(
    run: Run, good: Path, broken: Path
) -> None:
    done = run("nowhere", good, "nothing.zip", broken)
    assert done.stderr.splitlines() == [
        "subt-check: nothing.zip does not exist; check the spelling",
        "subt-check: nowhere does not exist; check the spelling",
    ]
    assert "2 packages, 1 ready" in done.stdout
    report = run("nowhere", good, "--format", "json")
    assert [each["name"] for each in packages(report.stdout)] == [GOOD]
    assert json.loads(report.stdout)["not_opened"] == [
        {"path": "nowhere", "reason": "does not exist; check the spelling", "failed": True}
    ]


def test_what_lies_beside_packages_and_is_none_is_named(
    run: Run, good: Path, broken: Path, tmp_path: Path
) -> None:
    (tmp_path / "notes").mkdir()
    (tmp_path / "linked").symlink_to(broken)
    done = run(tmp_path, "--select", "SDF001")
    assert f"not opened: {tmp_path}/notes contains no package" in done.stdout
    assert f"not opened: {tmp_path}/linked is a link" in done.stdout
    assert (good.parent, done.returncode) == (tmp_path, 1)


def test_a_package_given_twice_is_reported_once(run: Run, good: Path, tmp_path: Path) -> None:
    done = run(good, good.name, f"./{good.name}/", tmp_path, "--format", "json")
    assert [each["path"] for each in packages(done.stdout)] == [str(good)]


def test_two_files_and_two_archives_side_by_side_are_all_reported(
    run: Run, good: Path, tmp_path: Path
) -> None:
    for name in ("a.sdf", "b.sdf"):
        (tmp_path / name).write_text('<sdf version="1.6"><model name="m"/></sdf>')
    for name in ("a.zip", "b.zip"):
        with zipfile.ZipFile(tmp_path / name, "w") as archive:
            for file in ("package.xml", "model.sdf"):
                archive.write(good / file, f"{GOOD}/{file}")
    done = run("a.sdf", "b.sdf", "a.zip", "b.zip", "--format", "json")
    shown = [(each["name"], each["path"]) for each in packages(done.stdout)]
    assert shown == [
        ("a.sdf", "."),
        ("b.sdf", "."),
        (GOOD, f"a.zip/{GOOD}"),
        (GOOD, f"b.zip/{GOOD}"),
    ]


@pytest.mark.slow
@pytest.mark.parametrize("where", ["folder", "paths"])
def test_two_processes_report_what_one_does(
    where: str, run_apart: Run, good: Path, broken: Path, tmp_path: Path
) -> None:
    (tmp_path / "notes").mkdir()
    given = [tmp_path] if where == "folder" else [good, broken, "nowhere"]
    one, two = (run_apart(*given, "--format", "json", "--jobs", jobs) for jobs in (1, 2))
    assert packages(one.stdout) == packages(two.stdout)
    assert json.loads(one.stdout)["not_opened"] == json.loads(two.stdout)["not_opened"]
    assert (one.returncode, one.stderr) == (two.returncode, two.stderr)


def test_json_goes_to_a_file_and_nothing_to_the_terminal(
    run: Run, broken: Path, tmp_path: Path
) -> None:
    done = run(broken, "--format", "json", "--output", "new/report.json")
    assert (done.returncode, done.stdout, done.stderr) == (1, "", "")
    written = (tmp_path / "new/report.json").read_text("utf-8")
    assert packages(written) == packages(run(broken, "--format", "json").stdout)


def test_report_writes_json_beside_the_text(run: Run, good: Path, tmp_path: Path) -> None:
    done = run(good, "--report", "out")
    assert "Ready" in done.stdout
    assert packages((tmp_path / "out/report.json").read_text("utf-8"))


@pytest.mark.parametrize("option", ["--output", "--report"])
def test_a_place_that_cannot_be_written_is_named(run: Run, good: Path, option: str) -> None:
    done = run(good, option, good / "model.sdf/below")
    assert done.returncode == 2
    assert f"{good}/model.sdf/below" in done.stderr
    assert "cannot be written" in done.stderr


@pytest.mark.parametrize(
    ("arguments", "environment", "colored"),
    [
        ((), {}, False),
        ((), {"FORCE_COLOR": "1"}, True),
        ((), {"FORCE_COLOR": "1", "NO_COLOR": "1"}, False),
        (("--color", "always"), {}, True),
        (("--color", "always"), {"NO_COLOR": "1"}, True),
        (("--color", "never"), {"FORCE_COLOR": "1"}, False),
    ],
)
def test_colour_is_as_wished_and_never_says_anything_alone(
    arguments: tuple[str, ...], environment: dict[str, str], colored: bool, run: Run, broken: Path
) -> None:
    done = run(broken, *arguments, **environment)
    assert ("\x1b[" in done.stdout) is colored
    assert "error" in done.stdout
    assert "Not ready" in done.stdout


def test_a_file_gets_no_colour_unless_asked_for(run: Run, good: Path, tmp_path: Path) -> None:
    run(good, "--output", "a.txt", FORCE_COLOR="1")
    run(good, "--output", "b.txt", "--color", "always")
    assert "\x1b" not in (tmp_path / "a.txt").read_text("utf-8")
    assert "\x1b" in (tmp_path / "b.txt").read_text("utf-8")


@pytest.mark.parametrize(
    "arguments", ["{broken}", "rules", "rule PKG001", "{broken} --format json"]
)
def test_a_reader_that_goes_away_is_no_fault(arguments: str, broken: Path) -> None:
    words = arguments.format(broken=broken)
    script = f"{sys.executable} -m checker.cli {words} | head -n 1"
    done = subprocess.run(
        ["bash", "-o", "pipefail", "-c", script], capture_output=True, check=False
    )
    assert done.stderr == b""
    assert done.stdout.count(b"\n") == 1
    assert done.returncode == (1 if "broken" in words else 0)


def test_a_terminal_that_lacks_characters_shows_others(run_apart: Run, broken: Path) -> None:
    done = run_apart(broken, PYTHONIOENCODING="ascii")
    assert (done.returncode, done.stderr) == (1, "")


def test_a_rule_is_explained_by_id_or_name(run: Run) -> None:
    by_id, by_name = run("rule", "ref001"), run("rule", "absolute-uri")
    assert by_id.stdout == by_name.stdout
    assert by_id.returncode == 0
    for words in (
        "REF001 absolute-uri (error, about portability)",
        "Fix: ",
        "Source: ",
        "Example:",
        "Use instead:",
    ):
        assert words in by_id.stdout


@of_each("rule", all_rules(), ids=lambda rule: rule.id)
def test_every_rule_has_a_page(rule: Rule, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rule", rule.id]) == 0
    page = capsys.readouterr()
    assert page.out.startswith(
        f"{rule.id} {rule.name} ({rule.severity}, about {rule.concern.label})\n\n"
    )
    assert not re.search(r"^ *@", page.out, re.MULTILINE)


@pytest.mark.parametrize("word", ["refx01", "absolut-uri"])
def test_an_unknown_rule_gets_a_suggestion(run: Run, word: str) -> None:
    done = run("rule", word)
    assert (done.returncode, done.stdout) == (2, "")
    assert f"there is no rule {word!r}; did you mean " in done.stderr


def test_the_rules_are_listed_as_text_and_as_json(run: Run) -> None:
    listed = json.loads(run("rules", "--format", "json").stdout)
    lines = run("rules").stdout.splitlines()
    assert [each["id"] for each in listed] == [line.split()[0] for line in lines]
    told = {
        "id",
        "name",
        "severity",
        "concern",
        "title",
        "why",
        "fix",
        "source",
        "options",
        "option_words",
    }
    assert told == set(listed[0])


def test_a_package_that_is_called_like_a_command(run: Run, good: Path, tmp_path: Path) -> None:
    good.rename(tmp_path / "rules")
    done = run("./rules")
    assert done.stdout.startswith("rules  robot\n")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "usage: subt-check"),
        (["check"], "the following arguments are required: PATH"),
        (["--nonsense", "."], "unrecognized arguments: --nonsense"),
        (["check", ".", "--jobs", "0"], "'0' is not a number of processes, expected 1 or more"),
        (["check", ".", "--profile", "mars"], "invalid choice: 'mars'"),
        (["check", ".", "--format", "pdf"], "invalid choice: 'pdf'"),
    ],
)
def test_wrong_usage_ends_with_2(run: Run, arguments: list[str], said: str) -> None:
    done = run(*arguments)
    assert done.returncode == 2
    assert said in done.stdout + done.stderr


@pytest.mark.parametrize(
    ("arguments", "near"),
    [
        (["chek", "rover"], "'chek' is neither a command nor a path; did you mean 'check'?"),
        (["check", "rover", "--no-trail"], "did you mean '--no-trial'?"),
        (["check", "rover", "--distro", "jazy"], "did you mean 'jazzy'?"),
        (["roover"], "roover does not exist; did you mean rover?"),
        (["https://example.org/acme/rover.git"], "nothing is fetched: `git clone` it first"),
    ],
)
def test_wrong_usage_names_what_is_near(
    run: Run, tmp_path: Path, arguments: list[str], near: str
) -> None:
    (tmp_path / "rover").mkdir()
    done = run(*arguments)
    assert done.returncode == 2
    assert near in done.stderr
    assert done.stderr.count("\n") <= 2


def test_the_version_is_that_of_the_distribution(run: Run) -> None:
    done = run("--version")
    assert done.stdout.startswith("subt-check ")
    assert done.stdout != "subt-check unknown\n"


@pytest.mark.parametrize("option", ["--select", "--ignore"])
def test_an_unknown_rule_on_the_command_line(run: Run, good: Path, option: str) -> None:
    done = run(good, option, "REF999")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(
        f"subt-check: {option}: there is no rule 'REF999'; did you mean REF"
    )


def test_each_package_is_judged_by_its_own_settings(run: Run, good: Path, rover: Path) -> None:
    (rover / "launch/example.ign").unlink()
    (rover / "subt-check.toml").write_text('fail-on = "warning"\nselect = ["PKG003"]\n')
    (good / "subt-check.toml").write_text('profile = "sdf"\n')
    done = run(good, rover, "--format", "json")
    assert {each["name"]: each["profile"] for each in packages(done.stdout)} == {
        rover.name: "subt",
        GOOD: "sdf",
    }
    assert done.returncode == 1
    assert run(good, rover, "--fail-on", "error").returncode == 0


def test_settings_in_an_archive_count_and_those_beside_it_are_next(
    run: Run, good: Path, tmp_path: Path
) -> None:
    own = 'profile = "sdf"\n'
    for name, text in (("with.zip", own), ("without.zip", None)):
        with zipfile.ZipFile(tmp_path / name, "w") as archive:
            archive.write(good / "model.sdf", f"{GOOD}/model.sdf")
            if text:
                archive.writestr(f"{GOOD}/subt-check.toml", text)
    (tmp_path / "subt-check.toml").write_text('profile = "gazebo-harmonic"\n')
    done = run("with.zip", "without.zip", "--format", "json")
    profiles = {each["path"]: each["profile"] for each in packages(done.stdout)}
    assert profiles == {f"with.zip/{GOOD}": "sdf", f"without.zip/{GOOD}": "gazebo-harmonic"}


def test_wrong_settings_name_file_and_key_and_end_with_2(run: Run, good: Path) -> None:
    (good / "subt-check.toml").write_text('profile = "\\u001b[31mmars"\n')
    done = run(good)
    assert (done.returncode, done.stdout) == (2, "")
    said = "is not checked, because its settings cannot be used: subt-check.toml: profile is "
    assert done.stderr.startswith(f"subt-check: {good} {said}")
    assert "\x1b" not in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize(
    "text", ["profile = 'mars'", "[", "ignore = ['X']", "baseline = 'b.json'", "baseline = '..'"]
)
def test_wrong_settings_in_a_package_take_only_its_report(
    run: Run, good: Path, rover: Path, text: str
) -> None:
    (rover / "subt-check.toml").write_text(text)
    done = run(good.parent, "--no-trial", "--format", "json")
    assert done.returncode == 2
    assert [each["name"] for each in packages(done.stdout)] == [GOOD]
    assert f"{rover.name} is not checked, because its settings cannot be used: " in done.stderr
    with zipfile.ZipFile(rover.parent / "packed.zip", "w") as archive:
        for file in ("model.sdf", "subt-check.toml"):
            archive.write(rover / file, f"{rover.name}/{file}")
    assert run("packed.zip", "--no-trial").stderr.startswith(
        f"subt-check: packed.zip/{rover.name} is not checked, because its settings cannot be used: "
    )


def test_wrong_settings_above_the_packages_end_the_run(run: Run, good: Path, rover: Path) -> None:
    (good.parent / "subt-check.toml").write_text("profile = 'mars'")
    done = run(good, rover, "--no-trial")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"subt-check: {good.parent}/subt-check.toml: profile is 'mars'")


@pytest.mark.parametrize(
    "options",
    [
        *[["--files", each] for each in ("--fix", "--output=o", "--report=r", "--write-baseline")],
        *[["--write-baseline", each] for each in ("--fix", "--diff", "--output=o", "--report=r")],
        *[["--write-baseline", each] for each in ("--statistics", "--format=json")],
    ],
    ids=" ".join,
)
def test_options_that_do_not_go_together(run: Run, good: Path, options: list[str]) -> None:
    before = sorted(good.parent.rglob("*"))
    done = run(*options, "--", good)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("subt-check: --")
    assert sorted(good.parent.rglob("*")) == before


@pytest.mark.parametrize("name", ["--fix", "--output=made", "--report=made", "--", "-x"])
def test_a_changed_file_that_is_named_like_an_option_is_a_file(
    run: Run, good: Path, name: str, tmp_path: Path
) -> None:
    (good / name).write_text("")
    (tmp_path / name).write_text("")
    model = f"{good.name}/model.sdf"
    done = run("check", "--no-trial", "--files", "--", name, model, f"{good.name}/{name}")
    assert done.returncode in (0, 1), done.stderr
    assert f"{good.name}: " in done.stdout
    assert not (tmp_path / "made").exists()


@pytest.mark.parametrize("given", [GOOD, ".", "link"])
def test_a_folder_is_no_changed_file(run: Run, good: Path, given: str) -> None:
    (good.parent / "link").symlink_to(good)
    done = run("check", "--no-trial", "--files", "--", given)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"subt-check: {given} is a folder; leave out --files")


def test_an_error_is_shown_in_full_when_asked_for(good: Path) -> None:
    start = "import sys, checker.cli.check.command as c; c.run = None;"
    start += "from checker.cli import main; "
    command = [sys.executable, "-c", start + "sys.exit(main())", str(good)]
    short = subprocess.run(command, capture_output=True, text=True, check=False)
    assert short.returncode == 3
    assert short.stderr.startswith("subt-check: internal error (TypeError: ")
    assert short.stderr.count("\n") == 1
    environment = clean_environment() | {"SUBT_CHECK_DEBUG": "1"}
    long = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert "Traceback" in long.stderr
