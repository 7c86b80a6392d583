"""Files of MuJoCo (MJCF): which XML files are some, and which folders hold them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from checker.source.text import SourceText

if TYPE_CHECKING:
    from checker.package.package import Package

SUFFIXES = (".xml", ".mjcf")
_HEAD = 8_000
"""Characters of a file in which its root element is looked for."""
_PROLOGUE = re.compile(r"<!--.{0,8000}?-->|<\?.{0,500}?\?>", re.DOTALL)
_ROOT = re.compile(r"[\ufeff\s]{0,999}<mujoco[\s/>]")


def _is_model(text: str) -> bool:
    """Return whether a text begins as a whole model, not as a part that others include."""
    return _ROOT.match(_PROLOGUE.sub("", text[:_HEAD])) is not None


def mjcf_files(package: Package) -> tuple[str, ...]:
    """Return the files of a package that begin as a whole model of MuJoCo."""
    if package.only:
        paths = [package.only]
    else:
        paths = [file.path for file in package.index.with_suffix(*SUFFIXES)]
    return tuple(
        path
        for path in paths
        if not package.lies_in_unit(path)
        and isinstance(source := package.read(path), SourceText)
        and _is_model(source.text)
    )


def holds_mjcf(folder: Path, names: Iterable[str]) -> bool:
    """Return whether one of the files of a folder begins as a whole model of MuJoCo."""
    return any(
        _is_model(_head_of(folder / name)) for name in names if name.lower().endswith(SUFFIXES)
    )


def _head_of(file: Path) -> str:
    """Return the first characters of a file; empty if it is none or cannot be read."""
    try:
        if not file.is_file():
            return ""
        with file.open(encoding="utf-8", errors="replace") as opened:
            return opened.read(_HEAD)
    except OSError:
        return ""
