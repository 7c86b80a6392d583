"""The Python API is what docs/api.md says."""

from __future__ import annotations

import doctest
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import checker
import subt_check

ROOT = Path(__file__).parent.parent


def test_the_examples_of_the_page_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    outcome = doctest.testfile(str(ROOT / "docs/api.md"), module_relative=False, encoding="utf-8")
    assert outcome.attempted > 15
    assert outcome.failed == 0


def test_every_name_is_there() -> None:
    assert subt_check.__all__ == checker.__all__
    for name in subt_check.__all__:
        assert getattr(subt_check, name) is getattr(checker, name) is not None


def test_each_module_of_a_checkout_has_one_more_name() -> None:
    for name, own in (
        ("subt_check.rule", "checker.rule"),
        ("subt_check.model.robot", "checker.model.robot"),
        ("subt_check.rules.meshes", "rules.meshes"),
    ):
        assert import_module(name) is import_module(own)
        assert import_module(own).__name__ == own
    with pytest.raises(ModuleNotFoundError, match="nothing"):
        import_module("subt_check.nothing")


@pytest.mark.slow
def test_type_checkers_see_the_same_names(tmp_path: Path) -> None:
    code = "\n".join(
        f"from subt_check import {name}\nreveal_type({name})" for name in checker.__all__
    )
    (tmp_path / "uses.py").write_text(code, "utf-8")
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--strict",
        "--no-incremental",
        str(tmp_path / "uses.py"),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    assert done.returncode == 0, done.stdout
    assert "Any" not in re.findall(r'Revealed type is "(\w+)"', done.stdout)


def test_another_name_is_no_part_of_the_api() -> None:
    with pytest.raises(AttributeError, match="no attribute 'chekc'"):
        checker.chekc  # noqa: B018 - the look-up is what is tested


def test_the_command_loads_no_reader_before_it_needs_one() -> None:
    """`--version` and `--help` of an installed checkout take no longer than Python itself."""
    code = (
        "import sys, subt_check.cli; print(*{'lxml', 'msgspec', 'importlib.abc'} & {*sys.modules})"
    )
    done = subprocess.run(
        [sys.executable, "-S", "-c", code], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "\n", "")
