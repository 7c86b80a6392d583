"""Meanings that a new name already has."""

from __future__ import annotations

from collections.abc import Iterator

from checker.editor.names.mention import FileNames, NameKind, Role, WrittenName
from checker.editor.names.rename.request import Rename, place_of

_PARTS = frozenset({NameKind.LINK, NameKind.JOINT, NameKind.FRAME, NameKind.MODEL})
"""Kinds of which SDFormat gives no two parts of one model the same name."""


def name_conflict(rename: Rename) -> str:
    """Return why the new name is not free; empty if it is.

    A text that may name a part once there is one of its name counts too: the thing would have
    a mention that it never had.
    """
    new = rename.new
    for path, file, is_same in rename.files():
        if rename.kind is NameKind.PROPERTY and is_same and new in file.parameters:
            return f"{new!r} is already a parameter of a macro in {path}"
        used = next(_uses(rename, path, file), None)
        if used is not None:
            return f"{new!r} is already used at {place_of(path, file, used)}"
    for it in rename.index.composed_definitions(rename.kind):
        if it.mention.scope in rename.scopes and any(map(it.may_be, rename.new_full_names)):
            shown = rename.place_text(it.mention)
            return f"{new!r} may already be a {rename.kind} that is composed at {shown}"
    return ""


def _uses(rename: Rename, path: str, file: FileNames) -> Iterator[WrittenName]:
    """Yield what a file already calls by the new name, or by one below it."""
    kinds = _PARTS if rename.kind in _PARTS else {rename.kind}
    below = tuple(f"{name}/" for name in rename.new_full_names)
    is_topic = rename.kind is NameKind.TOPIC
    is_own = not path.startswith("../")
    for it in file.names:
        if not kinds.intersection(it.kinds) or not (is_own or it.role is Role.DEFINES):
            continue
        is_open = it.role is Role.MAY_NAME and it.name == rename.new
        if is_open or it.name in rename.new_full_names or (is_topic and it.name.startswith(below)):
            yield it
