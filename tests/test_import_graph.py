"""Dependencies point one way, and what is heavy is loaded only where it is used."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.each import of_each

ROOT = Path(__file__).parent.parent

LAYERS = (
    {"private", "record"},
    {"cache", "collection", "ending", "errors", "finding", "fingerprint", "loopback"},
    {"page", "parts", "resources", "saying", "versions"},
    {"output", "report", "source"},
    {"model", "package", "rule", "spawner"},
    {"sandbox"},
    {"confined"},
    {"checklist", "discovery", "dynamics", "flattening"}
    | {"mesh", "paperwork", "profiles", "rule_options", "spawning", "suppression"},
    {"rule_pages", "rule_text", "stages", "store", "trial", "xacro"},
    {"view"},
    {"display"},
    {"driving", "including", "launching", "settings"},
    {"controlling", "describing"},
    {"options", "subject"},
    {"engine", "facts", "patching", "recall"},
    {"measured", "suppressing"},
    {"judging"},
    {"check", "convert"},
    {"fixing"},
    {"doctor", "jobs", "migrate", "starting", "submitting"},
    {"web"},
    {"serving"},
    {"commands"},
    {"cli"},
)
"""Modules and packages of `checker`; each imports only what stands in an earlier row."""

FOR_RULES = {
    *("dynamics", "finding", "flattening", "launching", "model", "package", "paperwork"),
    *("record", "resources", "rule", "source", "spawner", "spawning", "suppression", "trial"),
}
"""What a rule may import: the parts of a package, and what a rule's author reads."""

HEAVY = {"dbos", "fastapi", "mujoco", "numpy", "pinocchio", "rich", "scipy", "trimesh", "yourdfpy"}
NOT_FOR_HELP = {"lxml", "markdown_it", "tree_sitter", "yaml", "rules"} | HEAVY


def modules(folder: str) -> list[Path]:
    return sorted((ROOT / folder).rglob("*.py"))


def imported(nodes: Iterator[ast.AST]) -> Iterator[str]:
    for node in nodes:
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are written in full"
            yield from (f"{node.module}.{name.name}" for name in node.names)
        elif isinstance(node, ast.Import):
            yield from (name.name for name in node.names)


def all_imports(path: Path) -> Iterator[str]:
    return imported(ast.walk(ast.parse(path.read_text("utf-8"))))


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


def unit_of(module: str) -> str:
    """Return the part of `checker` that a module belongs to."""
    return module.split(".")[1]


def layer_of(unit: str) -> int:
    layers = [number for number, units in enumerate(LAYERS) if unit in units]
    assert len(layers) == 1, f"checker.{unit} stands in no row of LAYERS, or in two"
    return layers[0]


@of_each("path", modules("checker"), ids=lambda path: str(path.relative_to(ROOT / "checker")))
def test_a_module_imports_only_what_lies_below_it(path: Path) -> None:
    unit = path.relative_to(ROOT / "checker").parts[0].removesuffix(".py")
    if unit == "__init__":
        assert not list(all_imports(path))
        return
    for module in all_imports(path):
        if module.startswith("checker.") and unit_of(module) != unit:
            assert layer_of(unit_of(module)) < layer_of(unit), module


def test_every_layer_names_what_exists() -> None:
    there = {path.stem for path in (ROOT / "checker").iterdir() if path.stem != "__pycache__"}
    assert set().union(*LAYERS) <= there


def test_rules_import_the_parts_of_a_package_and_nothing_above() -> None:
    for path in modules("rules"):
        for module in all_imports(path):
            if module.startswith("checker."):
                assert unit_of(module) in FOR_RULES, f"{path.name} imports {module}"
            assert not module.startswith("rules."), f"{path.name} imports another rule"


def test_the_checker_names_no_rule() -> None:
    for path in modules("checker"):
        assert not [m for m in all_imports(path) if m.split(".")[0] == "rules"], path
    discovery = (ROOT / "checker/rulebook/discovery.py").read_text("utf-8")
    assert 'importlib.import_module("rules")' in discovery


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
