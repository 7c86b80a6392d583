"""Names that several parts of one model have, and what libsdformat makes of them."""

from __future__ import annotations

from collections.abc import Mapping

from checker.source.xml import Element

KINDS = ("model", "include", "link", "joint", "frame")
"""Parts of a model that share one set of names, in the order in which libsdformat reads them."""
UNIQUE_SINCE = (1, 7)
"""SDF version from which on a name that is given twice is an error."""


def renames_of(model: Element, version: tuple[int, int]) -> Mapping[Element, str]:
    """Return the new names of parts whose name another kind of part has: `hinge_joint`.

    libsdformat renames them in files before SDF 1.7; two parts of one kind it never takes.
    """
    if version >= UNIQUE_SINCE:
        return {}
    taken: dict[str, str] = {}
    new: dict[Element, str] = {}
    children = [child for child in model.children if child.tag in KINDS]
    for child in sorted(children, key=lambda child: KINDS.index(child.tag)):
        name = name_of(child)
        if name and taken.setdefault(name, child.tag) != child.tag:
            new[child] = _free(f"{name}_{child.tag}", taken)
            taken[new[child]] = child.tag
    return new


def name_of(element: Element) -> str:
    """Return the name of a part; an include may give one to what it includes."""
    if element.tag == "include":
        name = element.child("name")
        return name.text.value if name is not None else ""
    return element.get("name") or ""


def _free(name: str, taken: Mapping[str, str]) -> str:
    """Return the name itself, or the first numbered one that nothing has."""
    if name not in taken:
        return name
    return next(f"{name}{n}" for n in range(len(taken) + 1) if f"{name}{n}" not in taken)
