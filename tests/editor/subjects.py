"""Packages of one file or a few, as an editor has them open."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from checker.base.cache import Cache, cache_folder
from checker.editor.completion.completion import completions_at
from checker.editor.completion.item import Completion
from checker.editor.hover.hover import hover_at
from checker.engine.subject import Subject
from checker.package.workspace import Workspace
from checker.source.text import SourceText

CARET = "¦"


def subject_of(folder: Path) -> Subject:
    """Return the subject of a package that lies in a folder."""
    folder = folder.resolve()
    return Subject(Workspace((folder.parent,)).at(folder), Cache(cache_folder()))


def written(folder: Path, files: Mapping[str, str]) -> Subject:
    """Write a package and return its subject; carets are left out of its texts."""
    for path, text in files.items():
        place = folder / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text.replace(CARET, ""), "utf-8")
    return subject_of(folder)


def text_of(subject: Subject, path: str) -> str:
    source = subject.package.read(path)
    assert isinstance(source, SourceText)
    return source.text


def shown(subject: Subject, path: str, needle: str, into: int | None = None) -> str:
    """Return what the hover in the middle of a text says; empty for none."""
    at = text_of(subject, path).index(needle) + (len(needle) // 2 if into is None else into)
    hover = hover_at(subject, path, at)
    return "" if hover is None else hover.markdown


def offered(subject: Subject, path: str, marked: str) -> dict[str, Completion]:
    """Return what is offered at the caret of a text, by label."""
    offset = marked.index(CARET)
    items = completions_at(subject, path, marked.replace(CARET, ""), offset)
    return {item.label: item for item in items}
