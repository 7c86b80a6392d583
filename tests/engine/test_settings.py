"""Settings come from the nearest file, and what is wrong in it is said in one sentence."""

from __future__ import annotations

from pathlib import Path

import pytest
from msgspec.structs import replace

from checker.base.errors import InvalidSettings
from checker.engine.options import check_against_rules, no_such_rule, options_of
from checker.rule import Concern, Findings, Rule, Severity, unchecked
from checker.settings import Settings, find_settings, folders_above


def check(
    *,
    limit: float = 1.0,
    count: int = 2,
    strict: bool = False,
    word: str = "a",
    names: tuple[str, ...] = ("a",),
    numbers: tuple[float, ...] = (0.5,),
    unnamed: tuple[str, ...] = (),
) -> Findings:
    yield unchecked(f"{limit} {count} {strict} {word} {names} {numbers} {unnamed}")


RULES = (
    Rule("SEN005", "lidar-scan-resolution", Severity.ERROR, Concern.INTERFACE, check, ""),
    Rule("INE001", "no-inertial", Severity.ERROR, Concern.ROBOT, check, ""),
)


def settings_from(text: str, folder: Path, name: str = "subt-check.toml") -> Settings:
    (folder / name).write_text(text)
    settings = find_settings([folder])
    check_against_rules(settings, RULES)
    return settings


def test_everything_that_can_be_set(tmp_path: Path) -> None:
    settings = settings_from(
        """profile = "sdf"
        distro = "humble"
        select = ["SEN", "INE001"]
        ignore = ["no-inertial"]
        fail-on = "warning"
        trial = false
        thorough = true
        [severity]
        SEN005 = "info"
        [rules.SEN005]
        limit = 3
        """,
        tmp_path,
    )
    assert settings == Settings(
        "sdf",
        True,
        ("SEN", "INE001"),
        ("no-inertial",),
        Severity.WARNING,
        {"SEN005": Severity.INFO},
        {"SEN005": {"limit": 3}},
        tmp_path / "subt-check.toml",
        trial=False,
        thorough=True,
        distro="humble",
    )
    assert "; without trial; thorough" in settings.description


@pytest.mark.parametrize(
    ("text", "chosen"),
    [
        ('select = ["concern:robot"]', ["INE001"]),
        ('ignore = ["concern:robot"]', ["SEN005"]),
        ('select = ["concern:robot", "SEN"]', ["SEN005", "INE001"]),
    ],
)
def test_rules_are_chosen_by_their_concern(text: str, chosen: list[str], tmp_path: Path) -> None:
    settings = settings_from(text, tmp_path)
    assert [rule.id for rule in RULES if settings.selects(rule)] == chosen


def test_a_concern_that_does_not_exist_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(InvalidSettings, match="did you mean concern:robot"):
        settings_from('select = ["concern:robots"]', tmp_path)


def test_package_path_names_folders_below_the_settings(tmp_path: Path) -> None:
    (tmp_path / "robots").mkdir()
    settings = settings_from('package-path = ["robots", "."]', tmp_path)
    assert settings.package_path == (tmp_path / "robots", tmp_path)


@pytest.mark.parametrize("value", ['"robots"', '[".."]', '["/usr"]', '["nowhere"]', "[3]"])
def test_a_package_path_elsewhere_is_refused(value: str, tmp_path: Path) -> None:
    with pytest.raises(InvalidSettings, match="package-path"):
        settings_from(f"package-path = {value}", tmp_path)


def test_a_section_of_pyproject_toml_will_do(tmp_path: Path) -> None:
    text = '[tool.ruff]\nline-length = 9\n[tool.subt-check]\nignore = ["SEN"]\n'
    assert settings_from(text, tmp_path, "pyproject.toml").ignore == ("SEN",)


@pytest.mark.parametrize("text", ["", "tool = 3", "[tool]\nx = 1", "[project]\nname = 'x'"])
def test_a_pyproject_toml_without_such_a_section_is_passed_over(text: str, tmp_path: Path) -> None:
    inner = tmp_path / "inner"
    inner.mkdir()
    (inner / "pyproject.toml").write_text(text)
    (tmp_path / "subt-check.toml").write_text('profile = "sdf"')
    assert find_settings(folders_above(inner)).profile == "sdf"


def test_an_own_file_counts_before_pyproject_toml(tmp_path: Path) -> None:
    (tmp_path / "pyproject.toml").write_text('[tool.subt-check]\nprofile = "urdf"')
    assert settings_from('profile = "sdf"', tmp_path).profile == "sdf"


def test_the_nearest_file_counts_alone(tmp_path: Path) -> None:
    package = tmp_path / "models/rover"
    package.mkdir(parents=True)
    (tmp_path / "subt-check.toml").write_text('ignore = ["SEN"]\nprofile = "sdf"')
    assert find_settings(folders_above(package)).profile == "sdf"
    (package / "subt-check.toml").write_text('ignore = ["INE"]')
    nearest = find_settings(folders_above(package))
    assert (nearest.ignore, nearest.profile) == (("INE",), "subt")


def test_the_search_ends_at_the_repository(tmp_path: Path) -> None:
    package = tmp_path / "repository/rover"
    (tmp_path / "repository/.git").mkdir(parents=True)
    package.mkdir()
    (tmp_path / "subt-check.toml").write_text('profile = "sdf"')
    assert find_settings(folders_above(package)) == Settings()


def test_the_search_ends_at_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(tmp_path / "me"))
    below = [tmp_path / "me/robots", tmp_path / "me"]
    assert list(folders_above(tmp_path / "me/robots")) == below


def test_a_user_without_a_home_has_settings_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_home() -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.setattr(Path, "home", no_home)
    (tmp_path / "subt-check.toml").write_text('profile = "sdf"')
    assert find_settings(folders_above(tmp_path / "rover")).profile == "sdf"


def test_the_search_ends_where_it_is_told_to(tmp_path: Path) -> None:
    below = [tmp_path / "a/b", tmp_path / "a"]
    assert list(folders_above(tmp_path / "a/b", top=tmp_path / "a")) == below


def test_the_command_line_replaces_what_it_names() -> None:
    settings = Settings(profile="sdf", ignore=("SEN",))
    changed = settings.with_overrides(profile=None, ignore=("INE",))
    assert changed == replace(settings, ignore=("INE",), commanded=("ignore",))


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("profile = !", "is not valid TOML: Invalid value (at line 1, column 11)"),
        (f"profile = {'[' * 3000}", "is nested too deeply"),
        ("fail_on = 'error'", "unknown key 'fail_on'; did you mean 'fail-on'?"),
        (
            "profile = 'gazebo-harmonik'",
            "profile is 'gazebo-harmonik'; did you mean 'gazebo-harmonic'?",
        ),
        ("colour = 1", "unknown key 'colour', expected one of profile, distro, select, "),
        ("profile = 'mars'", "profile is 'mars', expected one of subt, sdf, urdf, "),
        ("profile = ['subt']", "profile is ['subt'], expected one of subt, sdf, urdf, "),
        ("fail-on = 'info'", "fail-on is 'info', expected one of error, warning"),
        ("select = 'SEN005'", "select is 'SEN005', expected a list of rule ids"),
        ("ignore = [1]", "ignore is [1], expected a list of rule ids"),
        ("severity = 'error'", "severity is 'error', expected a table"),
        ("severity.SEN005 = 'fatal'", "severity.SEN005 is 'fatal', expected one of error, "),
        ("rules = []", "rules is [], expected a table"),
        ("rules.SEN005 = 1", "rules.SEN005 is 1, expected a table"),
        ("select = ['SEN006']", "there is no rule 'SEN006'; did you mean SEN005?"),
        ("ignore = ['sen005']", "there is no rule 'sen005'; did you mean SEN005?"),
        ("severity.SEN = 'info'", "there is no rule 'SEN'; did you mean SEN005?"),
        ("rules.XYZ123.limit = 1", "there is no rule 'XYZ123'; `subt-check rules` lists them"),
        ("rules.SEN005.limits = 1", "rules.SEN005 has no option 'limits', expected one of: limit,"),
        ("trial = 1", "trial is 1, expected true or false"),
        ("thorough = 'yes'", "thorough is 'yes', expected true or false"),
        ("rules.SEN005.limit = '1'", "rules.SEN005.limit is '1', expected a number"),
        ("rules.SEN005.limit = true", "rules.SEN005.limit is True, expected a number"),
        ("rules.SEN005.limit = nan", "rules.SEN005.limit is nan, expected a number"),
        ("rules.SEN005.limit = -0.5", "rules.SEN005.limit is -0.5, expected a number, 0 or more"),
        ("rules.SEN005.count = -1", "rules.SEN005.count is -1, expected a whole number, 0 or more"),
        (
            "rules.SEN005.numbers = [-2]",
            "rules.SEN005.numbers is [-2], expected a list in which each is a number, 0 or more",
        ),
        (
            "rules.SEN005.unnamed = [1]",
            "rules.SEN005.unnamed is [1], expected a list in which each is a string",
        ),
        ("rules.SEN005.count = 1.5", "rules.SEN005.count is 1.5, expected a whole number"),
        ("rules.SEN005.count = true", "rules.SEN005.count is True, expected a whole number"),
        ("rules.SEN005.strict = 1", "rules.SEN005.strict is 1, expected true or false"),
        ("rules.SEN005.word = 1", "rules.SEN005.word is 1, expected a string"),
        ("rules.SEN005.names = 'a'", "rules.SEN005.names is 'a', expected a list in which each is"),
        ("rules.SEN005.names = [1]", "rules.SEN005.names is [1], expected a list in which each is"),
    ],
)
def test_what_is_wrong_is_named_with_what_is_expected(
    text: str, problem: str, tmp_path: Path
) -> None:
    with pytest.raises(InvalidSettings) as caught:
        settings_from(text, tmp_path)
    said = str(caught.value)
    assert said.startswith(f"{tmp_path / 'subt-check.toml'}: {problem}")
    assert "\n" not in said


def test_a_section_that_is_no_table_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InvalidSettings, match=r"tool\.subt-check is 3, expected a table"):
        settings_from("[tool]\nsubt-check = 3", tmp_path, "pyproject.toml")


def test_a_file_that_is_no_text_or_too_long_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "subt-check.toml"
    file.write_bytes(b"\xff\x00\xfe")
    with pytest.raises(InvalidSettings, match=r"subt-check\.toml: "):
        find_settings([tmp_path])
    file.write_bytes(b"#" * 2_000_000)
    with pytest.raises(InvalidSettings, match="MB"):
        find_settings([tmp_path])


def test_options_take_the_types_of_their_defaults() -> None:
    given = {
        "limit": 3,
        "count": 4,
        "strict": True,
        "word": "b",
        "names": ["c", "d"],
        "numbers": [1, 2.5],
        "unnamed": ["e"],
    }
    options = options_of(RULES[0], Settings(options={"SEN005": given}))
    assert options == given | {"limit": 3.0, "names": ("c", "d"), "numbers": (1.0, 2.5)} | {
        "unnamed": ("e",)
    }
    assert isinstance(options["limit"], float)


def test_a_name_that_is_nearly_one_is_suggested() -> None:
    known = ["SEN005", "lidar-scan-resolution"]
    assert no_such_rule("sen05", known).endswith("did you mean SEN005?")
    assert no_such_rule("Lidar-Scan", known).endswith("did you mean lidar-scan-resolution?")
