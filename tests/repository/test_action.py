"""The action for GitHub: its steps, run by bash as a runner runs them."""

from __future__ import annotations

import json
import os
import platform
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import Any

import pytest
import yaml

from checker.cli import arguments
from tests.conftest import SAMPLES
from tests.repository.conftest import BROKEN, GOOD, ROOT

ACTION: dict[str, Any] = yaml.safe_load((ROOT / "action.yml").read_text("utf-8"))
NAME, CACHE, INSTALL, CHECK = ACTION["runs"]["steps"]
KEYED = ("checker/cli/__init__.py", "rules/__init__.py", "constraints.txt", "pyproject.toml")
SCRIPTS = (NAME, INSTALL, CHECK)
_GIVEN = re.compile(r"\$\{\{ ([\w.-]+) \}\}")


@pytest.fixture(scope="module")
def runner(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The environment of a runner on which all steps but the last have been done.

    The project is really installed; the libraries, 900 MB of them, are those of the tests.
    """
    temporary = tmp_path_factory.mktemp("runner")
    given = {"RUNNER_TEMP": str(temporary), "GITHUB_ACTION_PATH": str(ROOT)}
    environment = {**os.environ, **given, "GITHUB_OUTPUT": str(temporary / "output")}
    named = run(NAME, environment, temporary)
    assert named.returncode == 0, named.stdout + named.stderr
    environment |= {
        f"steps.environment.outputs.{name}": it for name, it in outputs(environment).items()
    }
    own = Path(environment["steps.environment.outputs.folder"])
    assert own.parent == temporary
    pip = [own / "bin/pip", "install", "-q", "-c", ROOT / "constraints.txt", "hatchling"]
    subprocess.run(["python3", "-m", "venv", own], check=True)
    subprocess.run(pip, check=True)
    without = {"PIP_NO_DEPS": "1", "PIP_NO_BUILD_ISOLATION": "0"}
    done = run(INSTALL, environment | without, temporary)
    assert done.returncode == 0, done.stdout + done.stderr
    installed = sysconfig.get_path("purelib")
    deeper = [place for place in sys.path if place.startswith(installed + os.sep)]
    (packages,) = own.glob("lib/python*/site-packages")
    (packages / "running.pth").write_text("\n".join([installed, *deeper, ""]))
    return environment


def bash(
    script: str, environment: dict[str, str], folder: Path
) -> subprocess.CompletedProcess[str]:
    """Run a script as `shell: bash` does."""
    command = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", script]
    return subprocess.run(
        command, env=environment, cwd=folder, capture_output=True, text=True, check=False
    )


def run(
    step: dict[str, Any], runner: dict[str, str], folder: Path, **inputs: str
) -> subprocess.CompletedProcess[str]:
    """Run a step with inputs, in words with `_` for `-`, and with the outputs of earlier steps."""
    values = {f"inputs.{name}": str(given["default"]) for name, given in ACTION["inputs"].items()}
    values |= {f"inputs.{name.replace('_', '-')}": value for name, value in inputs.items()}
    own = {
        name: _GIVEN.sub(lambda found: (runner | values)[found.group(1)], text)
        for name, text in step["env"].items()
    }
    return bash(step["run"], {**runner, **own}, folder)


def check(runner: dict[str, str], folder: Path, **inputs: str) -> subprocess.CompletedProcess[str]:
    return run(CHECK, runner, folder, **inputs)


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    for name in (GOOD, BROKEN):
        shutil.copytree(SAMPLES / name, tmp_path / name)
    return tmp_path


def outputs(runner: dict[str, str]) -> dict[str, str]:
    """Return the outputs of the steps since they were last asked for."""
    file = Path(runner["GITHUB_OUTPUT"])
    lines = file.read_text("utf-8").splitlines() if file.exists() else []
    file.write_text("")
    return dict(line.split("=", 1) for line in lines)


def test_no_input_stands_in_a_script() -> None:
    for step in SCRIPTS:
        assert step["shell"] == "bash"
        assert "${{" not in step["run"]
    assert "inputs" not in str(CACHE)
    texts = [text for step in SCRIPTS for text in step["env"].values()]
    taken = {name for text in texts for name in _GIVEN.findall(text) if name[:6] == "inputs"}
    assert taken == {f"inputs.{name}" for name in ACTION["inputs"]}


def test_what_is_cached_is_what_is_installed(runner: dict[str, str], tmp_path: Path) -> None:
    """An environment that is restored is not installed again."""
    folder, key = (f"${{{{ steps.environment.outputs.{name} }}}}" for name in ("folder", "key"))
    assert CACHE["with"] == {"path": folder, "key": key}
    assert INSTALL["env"]["FOLDER"] == CHECK["env"]["FOLDER"] == folder
    shutil.copy("/bin/false", tmp_path / "python3")
    environment = runner | {"PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}"}
    assert run(INSTALL, environment, tmp_path).returncode == 0
    environment["steps.environment.outputs.folder"] = str(tmp_path / "other")
    assert run(INSTALL, environment, tmp_path).returncode == 1


@pytest.mark.parametrize(("physics", "extras"), [("true", "[physics]"), ("false", "")])
def test_physics_is_an_extra(
    runner: dict[str, str], tmp_path: Path, physics: str, extras: str
) -> None:
    outputs(runner)
    assert run(NAME, runner, tmp_path, physics=physics).returncode == 0
    written = outputs(runner)
    assert written["extras"] == extras
    is_first = written["folder"] == runner["steps.environment.outputs.folder"]
    assert is_first == bool(extras)


def test_the_key_is_of_sources_libraries_extras_and_python(tmp_path: Path) -> None:
    copy = tmp_path / "copy"
    for name in ("scripts/environment_key", "scripts/hatch_build.py", *KEYED):
        (copy / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, copy / name)

    def key(extras: str) -> str:
        command = [sys.executable, copy / "scripts/environment_key", extras]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout

    first = key("[physics]")
    assert first == key("[physics]")
    assert first.startswith(f"subt-check-{sys.platform}-")
    assert f"-python{platform.python_version()}-" in first
    keys = {first, key("")}
    for name in KEYED:
        with (copy / name).open("a") as file:
            file.write("\n")
        keys.add(key("[physics]"))
    assert len(keys) == 2 + len(KEYED)


def test_inputs_name_all_profiles() -> None:
    said = ACTION["inputs"]["profile"]["description"]
    assert all(profile in said for profile in arguments.PROFILES)


def test_the_page_tells_of_all_inputs_and_outputs() -> None:
    page = (ROOT / "docs/github-actions.md").read_text("utf-8")
    told = re.findall(r"(?m)^\| `([\w-]+)` \|", page)
    assert told == [*ACTION["inputs"], *reversed(ACTION["outputs"])]
    (workflow,) = re.findall(r"(?s)```yaml\n(.*?)```", page)
    (job,) = yaml.safe_load(workflow)["jobs"].values()
    (step,) = (each for each in job["steps"] if each.get("id") == "check")
    assert set(step["with"]) <= set(ACTION["inputs"])
    assert set(re.findall(r"steps\.check\.outputs\.(\w+)", workflow)) == set(ACTION["outputs"])


def test_a_good_package_passes(runner: dict[str, str], checkout: Path) -> None:
    done = check(runner, checkout, path=GOOD, trial="false")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "::error" not in done.stdout


def test_faults_are_annotations_and_sarif(runner: dict[str, str], checkout: Path) -> None:
    outputs(runner)
    done = check(runner, checkout, path=f"{GOOD}\n\n{BROKEN}\n", trial="false")
    assert done.returncode == 1, done.stdout + done.stderr
    assert re.search(rf"^::error .*file={BROKEN}/model\.sdf,line=39\b", done.stdout, re.MULTILINE)
    written = outputs(runner)
    (run,) = json.loads(Path(written["sarif"]).read_text("utf-8"))["runs"]
    assert "REF001" in {result["ruleId"] for result in run["results"]}
    assert Path(written["sarif"]).parent == Path(written["report"])


def test_each_step_has_a_folder_of_its_own(runner: dict[str, str], checkout: Path) -> None:
    folders = []
    for _ in range(2):
        outputs(runner)
        assert check(runner, checkout, path=GOOD, trial="false").returncode == 0
        folders.append(outputs(runner)["report"])
    assert folders[0] != folders[1]
    assert all((Path(folder) / "report.html").is_file() for folder in folders)


def test_what_was_not_written_is_no_output(runner: dict[str, str], checkout: Path) -> None:
    outputs(runner)
    assert check(runner, checkout, path=GOOD, fail_on="never").returncode == 2
    assert outputs(runner) == {}


def test_warnings_fail_where_the_workflow_says_so(runner: dict[str, str], checkout: Path) -> None:
    (checkout / GOOD / "launch/example.ign").unlink()
    assert check(runner, checkout, path=GOOD, trial="false").returncode == 0
    assert check(runner, checkout, path=GOOD, trial="false", fail_on="warning").returncode == 1


@pytest.mark.parametrize(
    "inputs",
    [
        {"path": "'; touch run #"},
        {"path": '"; touch run; "'},
        {"path": "$(touch run)"},
        {"path": "`touch run`\n--output=run"},
        {"profile": "$(touch run)"},
        {"profile": "sdf --output run"},
        {"fail_on": "error; touch run"},
    ],
    ids=str,
)
def test_nothing_in_an_input_is_run(
    runner: dict[str, str], checkout: Path, inputs: dict[str, str]
) -> None:
    done = check(runner, checkout, **{"path": GOOD, "trial": "false", **inputs})
    assert done.returncode == 2
    assert not (checkout / "run").exists()
