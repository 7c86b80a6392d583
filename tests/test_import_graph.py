"""Imports: the layers of pyproject.toml, nothing heavy before it is used, and a quick `--help`."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
HEAVY = {
    "dbos",
    "fastapi",
    "httpx",
    "mujoco",
    "numpy",
    "pinocchio",
    "rich",
    "scipy",
    "trimesh",
    "yourdfpy",
}
NOT_FOR_HELP = {"lxml", "markdown_it", "tree_sitter", "yaml", "rules"} | HEAVY
LOOSE = {"__init__", "finding", "pipeline", "rule", "rule_testing", "settings"}


def modules(folder: str) -> list[Path]:
    return sorted((ROOT / folder).rglob("*.py"))


def imported(nodes: Iterator[ast.AST]) -> Iterator[str]:
    for node in nodes:
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are written in full"
            yield from (f"{node.module}.{name.name}" for name in node.names)
        elif isinstance(node, ast.Import):
            yield from (name.name for name in node.names)


def imports_when_loaded(path: Path) -> Iterator[str]:
    """Yield what a module imports as soon as it is imported itself."""
    waiting: list[ast.AST] = [ast.parse(path.read_text("utf-8"))]
    while waiting:
        node = waiting.pop()
        yield from imported(iter([node]))
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            continue
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            waiting += ast.iter_child_nodes(node)


def test_imports_keep_to_the_layers() -> None:
    command = [Path(sys.executable).with_name("lint-imports"), "--no-cache"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    assert done.returncode == 0, done.stdout + done.stderr


def test_rules_do_not_import_each_other() -> None:
    for path in modules("rules"):
        found = imported(ast.walk(ast.parse(path.read_text("utf-8"))))
        assert not [module for module in found if module.startswith("rules.")], path


def test_few_modules_stand_outside_of_the_rooms() -> None:
    assert {path.stem for path in (ROOT / "checker").glob("*.py")} <= LOOSE


@pytest.mark.parametrize("folder", ["checker", "rules"])
def test_nothing_heavy_is_imported_before_it_is_used(folder: str) -> None:
    for path in modules(folder):
        heavy = {module.split(".")[0] for module in imports_when_loaded(path)} & HEAVY
        assert not heavy, f"{path} imports {heavy}"


def test_help_loads_no_reader_and_no_rule() -> None:
    command = [sys.executable, "-X", "importtime", "-m", "checker.cli", "--help"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT)
    loaded = {line.rpartition("|")[2].strip().split(".")[0] for line in done.stderr.splitlines()}
    assert "argparse" in loaded
    assert not loaded & NOT_FOR_HELP
