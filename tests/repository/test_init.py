"""`subt-check init`: settings and a hook are written once, and nothing is overwritten."""

from __future__ import annotations

import re
import shutil
import tomllib
from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from checker.base.resources import templates
from checker.cli import main
from checker.cli.arguments import PROFILES
from checker.cli.init import HOOKS_FILE, guessed_profile, has_hook, hook_entry, init, with_hook
from checker.engine.options import check_against_rules
from checker.rulebook.discovery import all_rules
from checker.settings import find_settings, parse_settings
from tests.conftest import SAMPLES
from tests.repository.conftest import GOOD, ROOT, git, repository

URDF = "my_gurdy_description"
SDF_FILE = "<sdf version='1.9'><model name='m'>{}</model></sdf>"
OTHERS = """# Ours
repos:
- repo: https://example.org/hooks   # by hand
  rev: v1
  hooks:
  - id: whitespace
    args: ["a", 'b']

# What else
ci:
  autofix: false
"""


@pytest.fixture
def robots(tmp_path: Path) -> Path:
    robots = repository(tmp_path / "robots")
    shutil.copytree(SAMPLES / GOOD, robots / "models" / GOOD)
    return robots


def test_it_writes_settings_and_a_hook(robots: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["init", str(robots / "models")]) == 0
    wrote, hooked = capsys.readouterr().out.splitlines()
    assert wrote == f"wrote {robots}/models/subt-check.toml: profile subt (1 package for subt)"
    assert hooked.startswith(f"wrote {robots}/{HOOKS_FILE} with the hook subt-check; `pre-commit ")
    assert find_settings([robots / "models"]).profile == "subt"
    settings = (robots / "models/subt-check.toml").read_text("utf-8")
    assert f"# What the packages are made for: {', '.join(PROFILES)}.\n" in settings
    assert yaml.safe_load((robots / HOOKS_FILE).read_text("utf-8"))["repos"] == hook()
    assert main([str(robots / "models"), "--select", "PKG"]) == 0


def test_the_hook_is_one_that_git_runs(robots: Path) -> None:
    init(robots)
    assert git(robots, "status", "--short").splitlines() == [
        "?? .pre-commit-config.yaml",
        "?? models/",
        "?? subt-check.toml",
    ]
    published = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8"))[0]
    (ours,) = hook()[0]["hooks"]
    assert (ours["entry"], ours["args"]) == (published["entry"], published["args"])
    assert ours["require_serial"] == published["require_serial"]


def test_a_second_time_changes_nothing(robots: Path) -> None:
    init(robots)
    before = {path: path.read_bytes() for path in robots.glob("*.*") if path.is_file()}
    said = init(robots)
    settings = r".*subt-check\.toml already exists and is not changed\n"
    assert re.fullmatch(rf"{settings}.* already has the hook .* and is not changed\n", said)
    assert {path: path.read_bytes() for path in before} == before


def test_settings_above_are_left_to_rule(robots: Path) -> None:
    (robots / "pyproject.toml").write_text("[tool.subt-check]\nprofile = 'sdf'\n")
    kept = f"{robots}/pyproject.toml already exists and is not changed\n"
    assert init(robots / "models").startswith(kept)
    assert not (robots / "models/subt-check.toml").exists()


def test_a_hook_is_added_and_the_rest_stays(robots: Path) -> None:
    (robots / HOOKS_FILE).write_text(OTHERS)
    (robots / HOOKS_FILE).chmod(0o600)
    assert f"added the hook subt-check to {robots}/{HOOKS_FILE};" in init(robots)
    after = (robots / HOOKS_FILE).read_text("utf-8")
    assert after == OTHERS.replace("'b']\n", "'b']\n" + hook_entry())
    assert (robots / HOOKS_FILE).stat().st_mode & 0o777 == 0o600
    assert not list(robots.glob(f"{HOOKS_FILE}?*"))


UNSAFE = {
    "flow": "repos: [{repo: meta, hooks: [{id: identity}]}]\n",
    "empty": "",
    "empty list": "repos: []\n",
    "no list": "repos:\n",
    "another form": "- repo: x\n",
    "alias": "repos:\n- &a {repo: x, hooks: []}\n- *a\n",
    "bomb": "a: &a [1,1]\nb: &b [*a,*a]\nc: &c [*b,*b]\nrepos:\n- *c\n",
    "twice": "repos:\n- repo: x\nrepos:\n",
    "two documents": "repos:\n- repo: x\n---\nrepos:\n- repo: y\n",
    "text at the end": "repos:\n- repo: |\n    a\n    # b\n",
    "broken": "repos:\n- {\n",
    "deep": "repos:\n- " + "[" * 5000,
}


@pytest.mark.parametrize("text", UNSAFE.values(), ids=UNSAFE)
def test_where_it_is_not_safe_the_lines_are_printed(robots: Path, text: str) -> None:
    (robots / HOOKS_FILE).write_text(text)
    said = init(robots)
    assert "has a form to which the hook cannot be added safely; add this to its list" in said
    assert said.endswith(hook_entry())
    assert (robots / HOOKS_FILE).read_text("utf-8") == text


@pytest.mark.parametrize(
    "data", [b"repos:\n- repo: \xff\n", b"a" * 1_000_001], ids=["bytes", "big"]
)
def test_what_is_no_text_is_left_alone(robots: Path, data: bytes) -> None:
    (robots / HOOKS_FILE).write_bytes(data)
    assert "added no hook" in init(robots)
    assert (robots / HOOKS_FILE).read_bytes() == data


def test_links_are_not_written_through(robots: Path) -> None:
    outside = robots.parent / "outside.yaml"
    outside.write_text(OTHERS)
    (robots / HOOKS_FILE).symlink_to(outside)
    assert "added no hook" in init(robots)
    assert outside.read_text("utf-8") == OTHERS


@pytest.mark.parametrize("in_the_way", ["link", "folder"])
def test_something_else_in_place_of_the_settings(robots: Path, in_the_way: str) -> None:
    if in_the_way == "link":
        (robots / "subt-check.toml").symlink_to(robots.parent / "gone")
    else:
        (robots / "subt-check.toml").mkdir()
    left, hooked = init(robots).splitlines()
    assert left == f"{robots}/subt-check.toml is not changed: it is not a settings file"
    assert hooked.startswith(f"wrote {robots}/{HOOKS_FILE} with the hook subt-check")
    assert not (robots.parent / "gone").exists()


@pytest.mark.parametrize("in_the_way", ["link", "folder"])
def test_something_else_in_place_of_the_hooks(robots: Path, in_the_way: str) -> None:
    if in_the_way == "link":
        (robots / HOOKS_FILE).symlink_to(robots.parent / "gone")
    else:
        (robots / HOOKS_FILE).mkdir()
    assert f"added no hook: {robots}/{HOOKS_FILE} " in init(robots)
    assert not (robots.parent / "gone").exists()


def test_without_a_repository_there_is_no_hook(tmp_path: Path) -> None:
    assert f"added no hook: {tmp_path} is not in a git repository" in init(tmp_path)
    assert (tmp_path / "subt-check.toml").is_file()
    assert not (tmp_path / HOOKS_FILE).exists()


def test_what_is_no_folder_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "model.sdf").write_text(SDF_FILE)
    assert main(["init", str(tmp_path / "model.sdf")]) == 2
    assert "is not a folder; give the folder that contains the packages" in capsys.readouterr().err


@pytest.mark.parametrize("guessed", ["", *PROFILES])
def test_every_setting_of_the_template_is_valid(guessed: str, tmp_path: Path) -> None:
    source = templates("init").joinpath("subt-check.toml.j2").read_text("utf-8")
    text = re.sub(r"\{\{ reason \}\}", "no reason", source)
    text = re.sub(
        r"\{\{.*?\}\}", guessed or "subt", text.replace('{{ "" if profile else "# " }}', "")
    )
    assert parse_settings(tomllib.loads(text), tmp_path).profile == (guessed or "subt")
    all_on = re.sub(r"(?m)^# (?=[a-z_-]+ = |\[|[A-Z][A-Z0-9]{2}\d+ = )", "", text)
    settings = parse_settings(tomllib.loads(all_on), tmp_path)
    check_against_rules(settings, all_rules())
    assert all_on.count("\n#") == text.count("\n#") - 9
    assert settings.ignore
    assert settings.options["INE008"]


def test_the_profile_is_guessed_from_what_is_there(tmp_path: Path) -> None:
    assert guessed_profile(tmp_path / "gone").profile == ""
    shutil.copytree(SAMPLES / URDF, tmp_path / "urdf" / URDF)
    assert guessed_profile(tmp_path / "urdf").profile == "urdf"
    assert guessed_profile(tmp_path / "urdf" / URDF).profile == "urdf"
    model = tmp_path / "models/box/model.sdf"
    model.parent.mkdir(parents=True)
    model.write_text(SDF_FILE.format(""))
    assert guessed_profile(tmp_path / "models").profile == "gazebo-harmonic"
    manifest = tmp_path / "arms/arm/package.xml"
    manifest.parent.mkdir(parents=True)
    manifest.write_text("<package><name>arm</name><depend>rclpy</depend></package>")
    (manifest.parent / "arm.urdf").write_text("<robot name='arm'><link name='a'/></robot>")
    assert guessed_profile(tmp_path / "arms").profile == "ros2"
    shutil.copytree(SAMPLES / GOOD, tmp_path / "urdf" / GOOD)
    both = guessed_profile(tmp_path / "urdf")
    assert both.profile == ""
    assert both.reason.startswith(
        "1 package for subt, 1 package for urdf; each is checked with the profile"
    )


def test_without_a_guess_the_profile_is_a_comment(tmp_path: Path) -> None:
    init(tmp_path)
    assert not find_settings([tmp_path]).profile_chosen


def hook() -> list[dict[str, list[dict[str, object]]]]:
    return list(yaml.safe_load(hook_entry()))


_WORDS = st.text("ab-#:'\"é🙂 ", min_size=1, max_size=8)
_HOOKS = st.fixed_dictionaries(
    {"repo": _WORDS, "hooks": st.lists(st.fixed_dictionaries({"id": _WORDS}))}
)
_CONFIGURATIONS = st.fixed_dictionaries(
    {"repos": st.lists(_HOOKS, min_size=1)}, optional={"a": _WORDS, "z": st.lists(_WORDS)}
)


@given(_CONFIGURATIONS, st.sampled_from(["\n", "\r\n"]), st.booleans(), st.booleans())
def test_with_the_hook_a_configuration_holds_that_and_no_more(
    content: dict[str, object], line_end: str, indented: bool, ends: bool
) -> None:
    text = yaml.safe_dump(content, allow_unicode=True, sort_keys=False, width=1000)
    if indented:
        text = re.sub(r"(?m)^(?=- |  )", "  ", text)
    text = text.replace("\n", line_end)
    text = text if ends else text.rstrip()
    after = with_hook(text)
    assert after is not None
    assert has_hook(after)
    assert yaml.safe_load(after) == {**content, "repos": [*content["repos"], *hook()]}  # type: ignore[misc]
    lines = iter(after.splitlines())
    assert all(line in lines for line in text.splitlines())


@given(st.text("repos:-[]{}&*a \n#'\"|", max_size=60))
def test_whatever_the_text_nothing_is_lost(text: str) -> None:
    after = with_hook(text)
    if after is not None:
        before = yaml.safe_load(text)
        assert yaml.safe_load(after) == {**before, "repos": [*before["repos"], *hook()]}
