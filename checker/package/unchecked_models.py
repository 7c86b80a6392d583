"""Models in formats that this version does not check: USD and templates."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

_TEMPLATE = re.compile(r"(.{0,500}\.(?:sdf|urdf|world))\.(?:jinja2?|j2|erb|em)", re.IGNORECASE)
_USD = (".usd", ".usda", ".usdc", ".usdz")
_KINDS: Mapping[str, tuple[str, str]] = {
    "usd": ("a USD file", "USD files"),
    "template": ("a template of a model", "templates of models"),
}


def unchecked_models(paths: Iterable[str]) -> list[str]:
    """Return what the files of unchecked formats are, one clause for each format.

    A template whose result lies beside it is left out: that is checked.
    """
    known = [*paths]
    there = {path.lower() for path in known}
    found: dict[str, list[str]] = {}
    for path in known:
        if kind := _kind(path, there):
            found.setdefault(kind, []).append(path)
    return [_clause(kind, found[kind]) for kind in _KINDS if kind in found]


def _kind(path: str, there: set[str]) -> str:
    lower = path.lower()
    template = _TEMPLATE.fullmatch(lower)
    if template:
        return "" if template[1] in there else "template"
    return "usd" if lower.endswith(_USD) else ""


def _clause(kind: str, paths: list[str]) -> str:
    one, several = _KINDS[kind]
    if len(paths) == 1:
        return f"{paths[0]} is {one}, which this version does not check"
    return f"{paths[0]} and {len(paths) - 1} more are {several}, which this version does not check"
