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
HEAD = 8_000
"""Characters of a file in which its root element is looked for."""
_PROLOGUE = re.compile(r"<!--.{0,8000}?-->|<\?.{0,500}?\?>", re.DOTALL)
_ROOT = re.compile(r"[\ufeff\s]{0,999}<mujoco(include)?[\s/>]")


def is_mjcf(head: str, *, parts_too: bool = True) -> bool:
    """Return whether a text begins as a file of MuJoCo.

    Args:
        head: The beginning of the text.
        parts_too: Whether `<mujocoinclude>`, a part of other files, counts.
    """
    root = _ROOT.match(_PROLOGUE.sub("", head[:HEAD]))
    return root is not None and (parts_too or root[1] is None)


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
        and is_mjcf(source.text, parts_too=False)
    )


def holds_mjcf(folder: Path, names: Iterable[str]) -> bool:
    """Return whether one of the files of a folder begins as a whole model of MuJoCo."""
    return any(
        is_mjcf(head_of(folder / name), parts_too=False)
        for name in names
        if name.lower().endswith(SUFFIXES)
    )


def head_of(file: Path) -> str:
    """Return the first characters of a file; empty if it is none or cannot be read."""
    try:
        if not file.is_file():
            return ""
        with file.open(encoding="utf-8", errors="replace") as opened:
            return opened.read(HEAD)
    except OSError:
        return ""
