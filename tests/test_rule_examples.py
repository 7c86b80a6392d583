"""Every rule finds its fault in each bad example, at the marked line, and none in a good one."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from checker.rule import Rule
from checker.rule_testing import Example, check_example, examples_of
from checker.rulebook.discovery import all_rules

ROOT = Path(__file__).parent.parent
CASES = [
    pytest.param(rule, kind, example, id=f"{rule.id}-{kind}")
    for rule, kind, example in examples_of(all_rules())
]


@pytest.mark.parametrize(("rule", "kind", "example"), CASES)
def test_example(rule: Rule, kind: str, example: Example, tmp_path: Path) -> None:
    check_example(rule, kind, example, tmp_path)


def test_every_rule_has_examples_of_both_kinds() -> None:
    assert not [rule.id for rule in all_rules() if not (rule.good and rule.bad)]


RULE = '''"""A robot whose name is shouted.

People read it all day.

Fix: write it in small letters.
Source: the house style of Acme.
"""

from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("ACM001", "shouted-name", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report names in capital letters."""
    for link in robot.links:
        if link.name.value.isupper():
            yield finding(link.name, f"link {link.name.value!r} is written in capital letters")


GOOD = ['<link name="arm"/>']
BAD = [@EXAMPLE@]
'''
TEST = """import pytest

from checker.rule_testing import check_example, examples_of, rules_in


@pytest.mark.parametrize(("rule", "kind", "example"), examples_of(rules_in("acme_rules")))
def test_example(rule, kind, example, tmp_path):
    check_example(rule, kind, example, tmp_path)
"""


@pytest.mark.parametrize(
    ("example", "told"),
    [
        ('<link name="ARM"/>  <!-- ^ ACM001 -->', "2 passed"),
        ('<link name="ARM"/>', "reports ['model.sdf:5'], expected []"),
        ('<link name="arm"/>  <!-- ^ ACM001 -->', "reports [], expected ['model.sdf:5']"),
    ],
)
def test_a_rule_of_another_distribution_is_tested_by_the_kit(
    tmp_path: Path, example: str, told: str
) -> None:
    package = tmp_path / "acme_rules"
    package.mkdir()
    (package / "__init__.py").write_text('"""Rules of Acme."""\n', "utf-8")
    (package / "acm001_shouted_name.py").write_text(
        RULE.replace("@EXAMPLE@", repr(example)), "utf-8"
    )
    (tmp_path / "test_rules.py").write_text(TEST, "utf-8")
    pytest_itself = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"]
    command = [*pytest_itself, "--basetemp", str(tmp_path / "temporary"), str(tmp_path)]
    paths = f"{tmp_path}{os.pathsep}{ROOT}"
    done = subprocess.run(
        command,
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
        # The plugins that other tests use take seconds to load.
        env={**os.environ, "PYTHONPATH": paths, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
    )
    assert told in done.stdout
    assert (done.returncode == 0) is ("passed" in told)
