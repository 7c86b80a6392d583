"""Language server, service and migration can each be deleted: the rest does not notice."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
SAMPLE = ROOT / "samples/broken_rover_sensor_config_1"
PRODUCTS = {
    "editor": ("server",),
    "migrate": ("migrate",),
    "service": ("submit", "serve", "worker", "admin"),
}
"""Packages of the checker, and the commands that start them."""
IMPORTS = """
import importlib, os, pkgutil, checker, rules
assert checker.__file__.startswith(os.environ["PYTHONPATH"])
for package in (checker, rules):
    for module in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
        if not module.name.endswith("__main__"):
            importlib.import_module(module.name)
"""


def run(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-P", *words]
    variables = {**os.environ, "PYTHONPATH": str(folder)}
    return subprocess.run(command, capture_output=True, text=True, check=False, env=variables)


def findings(folder: Path) -> list[object]:
    words = ("-m", "checker.cli", "check", str(SAMPLE), "--no-trial", "--no-cache")
    report = json.loads(run(folder, *words, "--format", "json").stdout)
    return [package["findings"] for package in report["packages"]]


@pytest.fixture(scope="module")
def expected() -> list[object]:
    return findings(ROOT)


@pytest.mark.parametrize("product", PRODUCTS)
def test_the_rest_works_without_it(product: str, expected: list[object], tmp_path: Path) -> None:
    for name in ("checker", "rules", "templates"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.rmtree(tmp_path / "checker" / product)
    for command in PRODUCTS[product]:
        (tmp_path / f"checker/cli/{command}.py").unlink()

    imported = run(tmp_path, "-c", IMPORTS)
    assert imported.returncode == 0, imported.stderr
    shown = run(tmp_path, "-m", "checker.cli", "--help").stdout
    listed = {line.split()[0] for line in shown.splitlines() if line.startswith("    ")}
    assert listed.isdisjoint(PRODUCTS[product])
    assert listed >= {"check", "export", "rules"}
    assert findings(tmp_path) == expected
