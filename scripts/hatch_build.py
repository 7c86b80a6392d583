"""Builds the wheel: one package `subt_check`, with the rules, templates, samples and the 3D viewer.

A checkout has the packages `checker` and `rules`. A second `rules` in site-packages would be in the
way of others (django-rules has one), so the wheel holds both as `subt_check`; the one thing that is
changed in a file are its imports, so that lines of tracebacks stay. So no string names a module in
full (`f"{__package__}.worker"`), and imports are written `from … import`; tests check both. In a
checkout, `subt_check.py` makes each module of `checker` importable as one of `subt_check`.
`checker.base.resources` knows which layout it is.
"""

from __future__ import annotations

import ast
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NAME = "subt_check"
FOLDERS = {"checker": "", "rules": "rules", "samples": "samples", "templates": "templates"}
"""Where the folders of a checkout lie in the wheel's package."""
_IMPORT = re.compile(r"(\s*(?:from|import)\s+)(checker|rules)\b")
_WAYS = {"checker": NAME, "rules": f"{NAME}.rules"}
_VIEWER = "templates/report/viewer.js"
_UNWANTED = shutil.ignore_patterns("__pycache__", "*.pyc")
_SECONDS = 300


class CustomBuildHook(BuildHookInterface[Any]):
    """What hatchling calls."""

    _made = ""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Make what the distribution is packed from; an editable one needs nothing."""
        if version == "editable":
            return
        root = Path(self.root)
        _make_viewer(root)
        if self.target_name == "wheel":
            self._made = tempfile.mkdtemp()
            made = package_of(root, Path(self._made, NAME))
            build_data["force_include"][str(made)] = NAME

    def finalize(self, _version: str, _build_data: dict[str, Any], _path: str) -> None:
        """Remove what the distribution was packed from."""
        shutil.rmtree(self._made, ignore_errors=True)


def package_of(root: Path, target: Path) -> Path:
    """Make the package of the wheel.

    Args:
        root: The checkout, or an unpacked sdist.
        target: The folder to make.
    """
    for folder, inner in FOLDERS.items():
        copy = _copy_code if folder in _WAYS else shutil.copy2
        place = target / inner
        shutil.copytree(
            root / folder, place, ignore=_UNWANTED, copy_function=copy, dirs_exist_ok=True
        )
    return target


def _copy_code(source: str, target: str) -> None:
    if source.endswith(".py"):
        Path(target).write_bytes(with_own_imports(Path(source).read_bytes()))
    else:
        shutil.copy2(source, target)


def with_own_imports(code: bytes) -> bytes:
    """Return a module that imports from `subt_check` what it has from `checker` and `rules`.

    Raises:
        ValueError: It imports in a way that binds one of these names.
    """
    lines = code.decode("utf-8").splitlines(keepends=True)
    imports = (ast.Import, ast.ImportFrom)
    for node in (node for node in ast.walk(ast.parse(code)) if isinstance(node, imports)):
        for name in _imported(node):
            at = node.lineno - 1
            if isinstance(node, ast.Import) or _IMPORT.match(lines[at]) is None:
                raise ValueError(f"write `from {name} import …`: {lines[at].strip()}")
            lines[at] = _IMPORT.sub(lambda found: found[1] + _WAYS[found[2]], lines[at], count=1)
    return "".join(lines).encode()


def _imported(node: ast.Import | ast.ImportFrom) -> Iterator[str]:
    is_from = isinstance(node, ast.ImportFrom)
    names = [node.module or ""] if is_from else [alias.name for alias in node.names]
    yield from (name for name in names if name.partition(".")[0] in _WAYS)


def _make_viewer(root: Path) -> None:
    """Bundle the 3D viewer where npm is; without it the reports show pictures."""
    script, product = root / "templates/viewer/build", root / _VIEWER
    if product.is_file() and product.stat().st_mtime >= _changed(script.parent):
        return
    if shutil.which("node") and shutil.which("npm"):
        try:
            subprocess.run([script], check=True, timeout=_SECONDS, stdout=sys.stderr)  # noqa: S603
            return
        except (OSError, subprocess.SubprocessError) as error:
            _say(f"the 3D viewer cannot be built: {error}")
    if not product.is_file():
        _say("reports get no 3D viewer: install Node.js with npm, and build again")


def _changed(folder: Path) -> float:
    return max(path.stat().st_mtime for path in folder.rglob("*") if path.is_file())


def _say(words: str) -> None:
    sys.stderr.write(f"subt-check: {words}\n")
