"""What is not installed is said, with its remedy; the rules that do without it run."""

from __future__ import annotations

import re
import shutil
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml

from checker import cli
from checker.base import child_process, extras
from checker.base.extras import MCP, PHYSICS, SERVICE, Extra
from checker.cli.doctor import installation
from checker.cli.doctor.library_imports import module_of
from checker.pipeline import check_package
from checker.report.report import NO_PHYSICS, Cause, PackageReport, VerdictKind
from checker.report.summary import sentence
from checker.settings import Settings
from tests.conftest import SAMPLES

ROOT = SAMPLES.parent
SAMPLE = SAMPLES / "husky_migration_sensor_config_1"
REMEDY = "pip install 'subt-check[physics]'"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]


@pytest.fixture
def without(monkeypatch: pytest.MonkeyPatch) -> Callable[[Extra], None]:
    """Take the modules of an extra away."""

    def take_away(extra: Extra) -> None:
        found = extras._is_found
        monkeypatch.setattr(
            extras, "_is_found", lambda module: module not in extra.modules and found(module)
        )

    return take_away


def checked(settings: Settings, sample: Path = SAMPLE) -> PackageReport:
    (package,) = check_package(sample, settings).packages
    return package


def test_each_rule_that_needs_physics_says_so(without: Callable[[Extra], None]) -> None:
    without(PHYSICS)
    package = checked(Settings(cache=False, display=True))
    missed = {each.rule for each in package.not_checked if each.reason == NO_PHYSICS}
    assert {"INE001", "MSH001", "SEN019", "TRI002", "display"} <= missed
    assert {each.cause for each in package.not_checked if each.rule in missed} == {
        Cause.SWITCHED_OFF
    }
    assert not package.blind_spots
    assert package.trial is None
    assert package.display is None
    assert {"KIN001", "SDF001", "INE002"} <= set(package.looked)
    assert NO_PHYSICS.endswith(REMEDY)


def test_no_process_is_started_for_physics_that_is_not_there(
    without: Callable[[Extra], None], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    without(PHYSICS)
    monkeypatch.setattr(child_process, "launcher", lambda: pytest.fail("a child process starts"))
    # xacro is expanded in a child process as well.
    robot = shutil.copytree(
        SAMPLE, tmp_path / SAMPLE.name, ignore=shutil.ignore_patterns("*.xacro", "*.urdf")
    )
    package = checked(Settings(cache=False, display=True), robot)
    assert "KIN001" in package.looked


def test_the_verdict_says_that_physics_is_not_installed(without: Callable[[Extra], None]) -> None:
    without(PHYSICS)
    package = checked(Settings(cache=False))
    assert package.verdict is VerdictKind.READY
    assert str(sentence(package)) == "Ready: nothing to fix (physics is not installed)"
    package = checked(Settings(cache=False, trial=False))
    assert sentence(package).aside == "trial not run, physics is not installed"


def test_a_report_without_physics_is_not_remembered_once_it_is_there(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("SUBT_CHECK_CACHE", str(tmp_path))
    settings = Settings(select=("INE", "KIN"))
    with monkeypatch.context() as patch:
        patch.setattr(extras, "_is_found", lambda _: False)
        assert "INE001" not in checked(settings).looked
        assert checked(settings).timings.keys() == {"open", "recall"}
    assert "INE001" in checked(settings).looked
    with monkeypatch.context() as patch:
        patch.setattr(extras, "_is_found", lambda _: False)
        assert "INE001" not in checked(settings).looked


@pytest.mark.parametrize(
    ("words", "extra"),
    [
        (["export", str(SAMPLE), "--format", "urdf"], PHYSICS),
        (["migrate", str(SAMPLES / "husky_description"), "made", "--organization", "a"], PHYSICS),
        (["submit", str(SAMPLE), "--server", "http://127.0.0.1:1"], SERVICE),
        (["serve"], SERVICE),
        (["serve", "--workers", "0"], PHYSICS),
        (["worker"], SERVICE),
        (["admin", "list"], SERVICE),
        (["mcp"], MCP),
    ],
    ids=lambda value: value[0] if isinstance(value, list) else "",
)
def test_a_command_that_needs_an_extra_names_the_remedy(
    words: list[str],
    extra: Extra,
    without: Callable[[Extra], None],
    capsys: pytest.CaptureFixture[str],
) -> None:
    without(extra)
    assert cli.main(words) == 2
    said = capsys.readouterr()
    assert (said.out, said.err) == (
        "",
        f"subt-check: {words[0]} needs the extra '{extra.name}', which is not installed: "
        f"pip install 'subt-check[{extra.name}]'\n",
    )


def test_doctor_names_the_remedy(
    without: Callable[[Extra], None],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    without(PHYSICS)
    wanted = ["lxml>=6.0", "no-such-engine>=4.0; extra == 'physics'"]
    monkeypatch.setattr(installation, "requires", lambda _: wanted)
    assert cli.main(["doctor"]) == 0
    said = capsys.readouterr().out
    assert re.search(rf"(?m)^note    physics is not installed: .*; {re.escape(REMEDY)}$", said)
    assert "no-such-engine" not in said
    assert re.search(r"(?m)^ok      self-test: a sample robot is checked in", said)


@pytest.mark.parametrize("extra", [PHYSICS, SERVICE, MCP], ids=lambda extra: extra.name)
def test_modules_are_those_of_the_extra(extra: Extra) -> None:
    listed = {_name(each) for each in PROJECT["optional-dependencies"][extra.name]}
    modules = {module_of(each) for each in listed}
    assert modules == set(extra.modules)


def test_the_hook_with_trial_brings_physics() -> None:
    hooks = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8"))
    light, driven = hooks
    assert "additional_dependencies" not in light
    assert driven["additional_dependencies"] == PROJECT["optional-dependencies"]["physics"]


def _name(requirement: str) -> str:
    return re.split(r"[><=\[]", requirement)[0]
