"""Rules are found in `rules/` and in distributions that register the entry-point group."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from checker.rule import Rule
from checker.rulebook.discovery import all_rules
from checker.rulebook.pages import parse_page
from tests.each import of_each

RULE = '''"""A wheel of cheese.

It rolls away.

Fix: eat it.
Source: a kitchen.
"""
from subt_check.package.package import Package
from subt_check.rule import Concern, Findings, Severity, finding, rule


@rule("{id}", "cheese-wheel", Severity.WARNING, Concern.ROBOT)
def check(package: Package, *, ripe: bool = True) -> Findings:
    """Report every package."""
    yield finding(package.folder_place(), f"smells of cheese, ripe: {{ripe}}")
'''


@pytest.fixture
def distribution(tmp_path: Path) -> Path:
    """A folder like site-packages, with a distribution that carries a rule."""
    rules = tmp_path / "cheese_rules"
    rules.mkdir()
    (rules / "__init__.py").touch()
    (rules / "che001_wheel.py").write_text(RULE.format(id="CHE001"))
    about = tmp_path / "cheese_rules-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: cheese-rules\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text("[subt_check.rules]\ncheese = cheese_rules\n")
    return tmp_path


def command(site: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the command with a further folder of distributions."""
    start = f"import sys; sys.path.insert(0, {str(site)!r}); from checker.cli import main; "
    return subprocess.run(
        [sys.executable, "-c", start + "sys.exit(main())", *arguments],
        capture_output=True,
        text=True,
        check=False,
    )


def test_rules_of_another_distribution_run_with_their_options(
    distribution: Path, samples: Path
) -> None:
    package = samples / "husky_migration_sensor_config_1"
    done = command(distribution, str(package), "--select", "CHE", "--full")
    assert "warning CHE001 cheese-wheel: smells of cheese, ripe: True" in done.stdout
    assert "why: It rolls away." in done.stdout
    assert done.returncode == 0
    page = command(distribution, "rule", "cheese-wheel").stdout
    assert "Fix: eat it." in page
    assert "ripe = true" in page


def test_two_rules_of_one_id_are_refused_by_name(distribution: Path) -> None:
    again = distribution / "cheese_rules/che002_wheel.py"
    again.write_text(RULE.format(id="CHE001"))
    done = command(distribution, "rules")
    assert done.returncode == 2
    assert "two rules have the id CHE001" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_distribution_that_cannot_be_loaded_is_named(distribution: Path) -> None:
    (distribution / "cheese_rules/__init__.py").write_text("import no_such_module\n")
    done = command(distribution, "rules")
    assert done.returncode == 2
    assert done.stderr.startswith("subt-check: the rules of cheese_rules cannot be loaded: ")
    assert "no_such_module" in done.stderr


def test_a_module_of_a_distribution_that_cannot_be_loaded_is_named_alike(
    distribution: Path,
) -> None:
    (distribution / "cheese_rules/che001_wheel.py").write_text("import no_such_module\n")
    done = command(distribution, "rules")
    assert done.returncode == 2
    assert done.stderr.startswith("subt-check: the rules of cheese_rules cannot be loaded: ")
    assert "no_such_module" in done.stderr


def test_rules_are_sorted_and_their_files_bear_their_ids() -> None:
    ids = [rule.id for rule in all_rules()]
    assert ids == sorted(ids)
    assert len(ids) >= 18
    for rule in all_rules():
        assert Path(sys.modules[rule.check.__module__].__file__ or "").name.startswith(
            f"{rule.id.lower()}_"
        )


@of_each("rule", all_rules(), ids=lambda rule: rule.id)
def test_a_page_says_what_why_how_to_mend_it_and_where_it_comes_from(rule: Rule) -> None:
    page = parse_page(rule.page)
    assert page.title
    assert page.why
    assert page.fix
    assert page.source
