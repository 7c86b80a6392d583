"""Models in formats that this version does not check: MJCF, USD and templates."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping

_TEMPLATE = re.compile(r"(.{0,500}\.(?:sdf|urdf|world))\.(?:jinja2?|j2|erb|em)", re.IGNORECASE)
_USD = (".usd", ".usda", ".usdc", ".usdz")
_PROLOGUE = re.compile(r"<!--.{0,8000}?-->|<\?.{0,500}?\?>", re.DOTALL)
_ROOT = re.compile(r"[\ufeff\s]{0,999}<mujoco(?:include)?[\s/>]")
HEAD = 8_000
"""Characters of a file in which its root element is looked for."""
_KINDS: Mapping[str, tuple[str, str]] = {
    "mjcf": ("a MuJoCo model (MJCF)", "MuJoCo models (MJCF)"),
    "usd": ("a USD file", "USD files"),
    "template": ("a template of a model", "templates of models"),
}


def is_mjcf(head: str) -> bool:
    """Return whether a text begins as a file of MuJoCo."""
    return _ROOT.match(_PROLOGUE.sub("", head[:HEAD])) is not None


def unchecked_models(paths: Iterable[str], head: Callable[[str], str]) -> list[str]:
    """Return what the files of unchecked formats are, one clause for each format.

    A template whose result lies beside it is left out: that is checked.

    Args:
        paths: Files, of which those that begin as another format are read.
        head: Returns the first characters of a file; empty if it cannot be read.
    """
    known = [*paths]
    there = {path.lower() for path in known}
    found: dict[str, list[str]] = {}
    for path in known:
        if kind := _kind(path, there, head):
            found.setdefault(kind, []).append(path)
    return [_clause(kind, found[kind]) for kind in _KINDS if kind in found]


def _kind(path: str, there: set[str], head: Callable[[str], str]) -> str:
    lower = path.lower()
    template = _TEMPLATE.fullmatch(lower)
    if template:
        return "" if template[1] in there else "template"
    if lower.endswith(_USD):
        return "usd"
    is_model = lower.endswith(".mjcf") or (lower.endswith(".xml") and is_mjcf(head(path)))
    return "mjcf" if is_model else ""


def _clause(kind: str, paths: list[str]) -> str:
    one, several = _KINDS[kind]
    if len(paths) == 1:
        return f"{paths[0]} is {one}, which this version does not check"
    return f"{paths[0]} and {len(paths) - 1} more are {several}, which this version does not check"
