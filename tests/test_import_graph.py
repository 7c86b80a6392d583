"""Imports: the layers of pyproject.toml, nothing heavy before it is used, and a quick `--help`."""

from __future__ import annotations

import ast
import re
import runpy
import subprocess
import sys
from collections.abc import Iterator
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
HEAVY = {
    "psycopg",
    "fastapi",
    "mujoco",
    "numpy",
    "pinocchio",
    "rich",
    "scipy",
    "trimesh",
    "yourdfpy",
}
NOT_FOR_HELP = {"httpx", "lxml", "markdown_it", "tree_sitter", "yaml", "rules"} | HEAVY
MODULE = re.compile(r"(checker|rules)\.(?!html|j2)\w+(\.\w+)*\.?")
FOR_RULES = (
    *("rule", "finding", "model", "formats", "robots", "launch", "ros", "package", "source"),
    *("physics.compiled", "physics.mass", "physics.trial"),
    *("rulebook.suppression.parts", "rulebook.example_parts"),
    *("base.words", "base.record", "base.resources", "base.files"),
)
"""What rules may import of the checker: the parts of a package and tables, nothing that reads
files, starts processes, runs rules or reports."""
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


def imports_of(path: Path) -> Iterator[str]:
    """Yield what a module imports, at any time."""
    return imported(ast.walk(ast.parse(path.read_text("utf-8"))))


def imports_when_loaded(path: Path, *, or_later: bool = False) -> Iterator[str]:
    """Yield what a module imports as soon as it is imported itself, or in its functions too."""
    waiting: list[ast.AST] = [ast.parse(path.read_text("utf-8"))]
    while waiting:
        node = waiting.pop()
        yield from imported(iter([node]))
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            continue
        if or_later or not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            waiting += ast.iter_child_nodes(node)


def test_rules_import_parts_and_tables_alone() -> None:
    allowed = tuple(f"checker.{name}." for name in FOR_RULES)
    for path in modules("rules"):
        ours = (name for name in imports_of(path) if name.startswith("checker"))
        assert not [name for name in ours if not name.startswith(allowed)], path


def test_benches_do_not_import_tests() -> None:
    for path in (*modules("bench"), *modules("support")):
        assert not [name for name in imports_of(path) if name.startswith("tests")], path


def test_imports_keep_to_the_layers() -> None:
    command = [Path(sys.executable).with_name("lint-imports"), "--no-cache"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    assert done.returncode == 0, done.stdout + done.stderr


def test_modules_import_each_other_in_one_direction() -> None:
    """Imports inside functions count; those for types alone do not."""
    paths = {
        ".".join(each.relative_to(ROOT).with_suffix("").parts): each for each in modules("checker")
    }
    graph = {}
    for name, path in paths.items():
        found = set(imports_when_loaded(path, or_later=True))
        graph[name] = (found | {each.rpartition(".")[0] for each in found}) & paths.keys()
    TopologicalSorter(graph).prepare()


def test_rules_do_not_import_each_other() -> None:
    for path in modules("rules"):
        found = imports_of(path)
        assert not [module for module in found if module.startswith("rules.")], path


def test_few_modules_stand_outside_of_the_rooms() -> None:
    assert {path.stem for path in (ROOT / "checker").glob("*.py")} <= LOOSE


@pytest.mark.parametrize("folder", ["checker", "rules"])
def test_nothing_heavy_is_imported_before_it_is_used(folder: str) -> None:
    for path in modules(folder):
        heavy = {module.split(".")[0] for module in imports_when_loaded(path)} & HEAVY
        assert not heavy, f"{path} imports {heavy}"


@pytest.mark.slow
def test_imports_can_be_written_for_the_wheel() -> None:
    """There, `checker` is called `subt_check`: no string names a module in full."""
    hook = runpy.run_path(str(ROOT / "scripts/hatch_build.py"))
    for path in (*modules("checker"), *modules("rules")):
        code = hook["with_own_imports"](path.read_bytes())
        tree = ast.parse(code)
        assert not [
            name for name in imported(ast.walk(tree)) if name.partition(".")[0] in hook["FOLDERS"]
        ], path
        texts = (node.value for node in ast.walk(tree) if isinstance(node, ast.Constant))
        named = [text for text in texts if isinstance(text, str) and MODULE.fullmatch(text)]
        assert not named, path


def test_an_import_that_binds_a_name_is_refused() -> None:
    hook = runpy.run_path(str(ROOT / "scripts/hatch_build.py"))
    with pytest.raises(ValueError, match="write `from checker"):
        hook["with_own_imports"](b"import checker.rule\n")
    code = b"if True:\n    from rules.a import (  # from checker\n        b,\n    )\n"
    assert hook["with_own_imports"](code) == code.replace(b"rules.a", b"subt_check.rules.a")


def test_help_loads_no_reader_and_no_rule() -> None:
    command = [sys.executable, "-X", "importtime", "-m", "checker.cli", "--help"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT)
    loaded = {line.rpartition("|")[2].strip().split(".")[0] for line in done.stderr.splitlines()}
    assert "argparse" in loaded
    assert not loaded & NOT_FOR_HELP
