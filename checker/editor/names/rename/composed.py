"""Names that expressions compose, and that may be the name of a thing."""

from __future__ import annotations

from checker.editor.names.mention import NameKind, WrittenName
from checker.editor.names.readers.expressions import (
    EXPRESSION,
    is_composed,
    is_computed,
    may_come_to,
)
from checker.editor.names.rename.request import Rename, place_of


def composed_conflict(rename: Rename) -> str:
    """Return which composed name may be that of the thing, or come from it; empty for none."""
    old = rename.old
    if is_composed(old):
        made = next(iter(rename.index.mentions_from_composed(rename.mention)), None)
        if made is not None:
            return (
                f"{rename.place_text(made)} names {rename.text(made)!r}, which {old!r} "
                "may come to; it cannot be changed along"
            )
    for path, file, _ in rename.files():
        if path.startswith("../"):
            continue
        for it in file.names:
            if rename.kind in it.kinds and _may_be(rename, path, it):
                return (
                    f"{place_of(path, file, it)} composes a name that may be {old!r}: "
                    f"{it.name!r}; it cannot be changed along"
                )
    return ""


def _may_be(rename: Rename, path: str, name: WrittenName) -> bool:
    """Return whether a written name is composed, and may be the name of the thing."""
    if name.name in rename.names or not is_composed(name.name):
        return False
    if is_computed(name.name):
        # A parameter that takes the property of its own name from the caller.
        return rename.kind is NameKind.PROPERTY and name.name == f"${{{rename.old}}}"
    if is_composed(rename.old) and _is_own(rename, path, name.name):
        return False
    scopes = rename.index.scopes
    values = scopes.values.get(scopes.xacro[path], frozenset())
    is_topic = rename.kind is NameKind.TOPIC
    old = rename.mention.name if is_topic else rename.old
    text = name.name if is_topic else name.name.rpartition("::")[2]
    if not is_composed(old):
        return may_come_to(text, old, values)
    # Expressions of the other may come to anything: only what is written out has to fit.
    return may_come_to(text, EXPRESSION.sub("\ufffd", old), None)


def _is_own(rename: Rename, path: str, name: str) -> bool:
    """Return whether a composed name is that of another thing."""
    scope = rename.index.scopes.robots.get(path, "")
    definitions = (it.mention for it in rename.index.composed_definitions(rename.kind))
    return any(it.scope == scope and it.name == name for it in definitions)
