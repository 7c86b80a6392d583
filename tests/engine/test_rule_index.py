"""Rules from the index are those of the modules, which are loaded when they run."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from checker.base.cache import NO_CACHE, Cache
from checker.rule import Rule
from checker.rulebook.discovery import all_rules
from checker.rulebook.rule_index import rules
from tests.conftest import SAMPLES


@pytest.fixture
def indexed(tmp_path: Path) -> tuple[Rule, ...]:
    rules(Cache(tmp_path))
    return rules(Cache(tmp_path))


def test_the_index_says_what_the_modules_say(indexed: tuple[Rule, ...]) -> None:
    said = [
        (it.id, it.name, it.severity, it.concern, it.page, it.needs, it.optional_parts, it.options)
        for it in indexed
    ]
    assert said == [
        (it.id, it.name, it.severity, it.concern, it.page, it.needs, it.optional_parts, it.options)
        for it in all_rules()
    ]
    assert all(
        type(value) is type(rule.options[name])
        for rule, own in zip(all_rules(), indexed, strict=True)
        for name, value in own.options.items()
    )


def test_a_rule_of_the_index_runs_as_its_module_does(indexed: tuple[Rule, ...]) -> None:
    (rule,) = (rule for rule in indexed if rule.id == "CFG001")
    assert rule.needs == {"suppressions": "checker.rulebook.suppression.parts:Suppressions"}
    with pytest.raises(TypeError, match="nonsense"):
        list(rule.check(nonsense=1))


@pytest.mark.parametrize("content", ["", "[]x", "{}", '[{"id": 1}]'])
def test_a_foreign_index_counts_as_none(tmp_path: Path, content: str) -> None:
    rules(Cache(tmp_path))
    (entry,) = tmp_path.glob("rules/*/*.json")
    entry.write_text(content, "utf-8")
    assert [rule.id for rule in rules(Cache(tmp_path))] == [rule.id for rule in all_rules()]


def test_without_a_cache_all_rules_are_loaded() -> None:
    assert rules(NO_CACHE) is all_rules()


def test_a_static_check_loads_nothing_heavy_and_few_rules(tmp_path: Path) -> None:
    name = "husky_migration_sensor_config_1"
    sample = shutil.copytree(SAMPLES / name, tmp_path / name)
    run = (
        "import sys; from checker.cli import main;"
        "main([sys.argv[1], '--no-trial', '-q', *sys.argv[2:]]);"
        "print(*(name for name in sys.modules))"
    )
    # The second time, what the meshes hold and what Pinocchio says is known; the report is not.
    for options in ([], ["--ignore", "SEN001"]):
        done = subprocess.run(
            [sys.executable, "-c", run, str(sample), *options],
            capture_output=True, text=True, check=True,
            env={"SUBT_CHECK_CACHE": str(tmp_path / "cache"), "PATH": "/usr/bin:/bin"},
            cwd=SAMPLES.parent,
        )  # fmt: skip
    loaded = done.stdout.split()
    heavy = {"numpy", "scipy", "rich", "jinja2", "mujoco", "pinocchio", "trimesh", "yourdfpy"}
    late = {"tarfile", "zipfile", "tomllib", "multiprocessing", "ssl", "importlib.metadata"}
    assert not (heavy | late) & set(loaded)
    of_rules = [name for name in loaded if name.count(".") == 2 and name.startswith("rules.")]
    assert 0 < len(of_rules) < 0.8 * len(all_rules())
    assert not [name for name in of_rules if name.startswith(("rules.trial.", "rules.bridges."))]
