"""A thing gets another name in all files of its package, or in none."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.editor.names.mention import Mention
from checker.editor.names.readers.expressions import is_computed, literal_pieces
from checker.editor.names.rename.composed import composed_conflict
from checker.editor.names.rename.dependent import dependent
from checker.editor.names.rename.request import Rename
from checker.editor.names.rename.spelling import invalid
from checker.editor.names.rename.taken import name_conflict
from checker.finding import Edit
from checker.source.text import Span

if TYPE_CHECKING:
    from checker.editor.names.index import NameIndex


def rename_edits(index: NameIndex, mention: Mention, new: str) -> tuple[Edit, ...] | str:
    """Return the edits that give a thing another name, or why it cannot have it.

    Args:
        index: The index of the package.
        mention: Any of the thing.
        new: The new name, without the models around the thing; of a topic, without the model's
            name and without a leading slash.
    """
    rename = Rename(index, mention, new)
    if new == rename.old:
        return ()
    refused = next(filter(None, (reason(rename) for reason in _REASONS)), "")
    return refused or tuple(_edits(rename))


def _edits(rename: Rename) -> Iterator[Edit]:
    files = rename.index.files
    places = {(it.path, it.start, it.end) for it in rename.mentions}
    for path, start, end in sorted(places):
        yield Span(files[path].source, start, end).replacement(rename.new)


def _invalid(rename: Rename) -> str:
    if is_computed(rename.old):
        return f"{rename.old!r} is computed where the thing is made; change it there"
    return invalid(rename.kind, rename.old, rename.new)


def _undefined(rename: Rename) -> str:
    if any(it.is_definition for it in rename.mentions):
        return ""
    what = f"{rename.kind} {rename.old!r}"
    made = next(iter(rename.index.definitions(rename.mention)), None)
    if made is None:
        return f"{what} is not defined in this package"
    return (
        f"the name of {what} is composed by an expression at {rename.place_text(made)}: "
        f"{made.name!r}; change it there"
    )


def _elsewhere(rename: Rename) -> str:
    """State that the thing belongs to another package, or is written where no edit can be made."""
    for it in rename.mentions:
        if it.path.startswith("../"):
            how = "defined" if it.is_definition else "named"
            what = f"{rename.kind} {rename.old!r}"
            return f"{what} is {how} in another package, {rename.place_text(it)}"
    for it in rename.mentions:
        if rename.text(it) != rename.old:
            return f"{rename.place_text(it)} composes {rename.old!r}; it cannot be changed along"
    return ""


def _ambiguous(rename: Rename) -> str:
    """Return the message that a text may name the thing, or another one."""
    own = {(it.kind, it.scope, it.name) for it in rename.mentions}
    for it in rename.mentions:
        for other in rename.index.possible_mentions(it):
            if (other.kind, other.scope, other.name) not in own:
                return (
                    f"{rename.place_text(it)} may name the {it.kind} or the {other.kind} "
                    f"{rename.old!r}; give one of them another name there first"
                )
    return ""


def _nested(rename: Rename) -> str:
    """State that a dot would make another key of a parameter: `gains.left.p` with `left.1`."""
    for it in rename.mentions:
        text = rename.index.files[it.path].source.text
        around = text[max(0, it.start - 1) : it.start] + text[it.end : it.end + 1]
        if "." in rename.new and "." in around:
            return f"{rename.new!r} has a dot, which makes other keys of {rename.place_text(it)}"
    return ""


def _unread(rename: Rename) -> str:
    """Return the message that a file which contains the name cannot be read."""
    literal = max(literal_pieces(rename.old), key=len)
    for path, file in rename.index.files.items():
        if file.fault and literal in file.source.text:
            return f"{path} may name {rename.old!r} and cannot be read: {file.fault}"
    return ""


_REASONS = (
    *(
        _invalid,
        _undefined,
        _elsewhere,
        _ambiguous,
        _nested,
        composed_conflict,
        name_conflict,
        _unread,
        dependent,
    ),
)
