"""Suppressions: a comment with a reason, and rules that the settings leave out."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from pathlib import Path

from lsprotocol import types as lsp

from checker.base.files import NotReadable
from checker.base.record import Record
from checker.editor.changes import Changes
from checker.editor.documents import Document
from checker.editor.positions import Columns
from checker.editor.session import State
from checker.rulebook.suppression.comments import comments_of, has_comments, has_xml_comments
from checker.settings import FILE_NAME, SHARED_FILE_NAME, SIZE_LIMIT
from checker.source.text import SourceText
from checker.source.text_file import read_text
from checker.source.xml import XmlDocument, parse_xml

REASON = "TODO: say why"
"""Stands where the user writes the reason."""
_INDENTATION = re.compile(r"[ \t]*")


class Insertion(Record):
    """A text, and the character offset at which it is put in."""

    at: int
    text: str


def reason_comment(source: SourceText, rule: str, line: int) -> Insertion | None:
    """Return a comment that suppresses a rule at a line.

    It is above the line; behind it, where a start tag goes over several lines. None where
    neither can be, or where files of this kind have no comments that count.

    Args:
        source: The file.
        rule: Id of the rule.
        line: The line, counted from 1.
    """
    if not has_comments(source.file):
        return None
    mark = f"subt-check: ignore[{rule}] {REASON}"
    comment = f"<!-- {mark} -->" if has_xml_comments(source.file) else f"# {mark}"
    start = source.offset_of(line, 1)
    if start is None:
        return None
    text = source.line(line)
    indentation = _INDENTATION.match(text)
    above = f"{indentation.group() if indentation else ''}{comment}\n"
    is_xml = isinstance(parse_xml(source), XmlDocument)
    for insertion in (Insertion(start, above), Insertion(start + len(text), f"  {comment}")):
        if _counts(source, insertion, rule, line, is_xml=is_xml):
            return insertion
    return None


def _counts(
    source: SourceText, insertion: Insertion, rule: str, line: int, *, is_xml: bool
) -> bool:
    """Return whether a comment applies to the line and does not change the meaning of the file."""
    text = source.text
    edited = SourceText(
        source.file, text[: insertion.at] + insertion.text + text[insertion.at :], source.encoding
    )
    if is_xml and not isinstance(parse_xml(edited), XmlDocument):
        return False
    moved = line + insertion.text.count("\n")
    about = (comment for comment in comments_of(edited) if rule in comment.names)
    return any(comment.reason == REASON and moved in comment.lines for comment in about)


def rule_switched_off(
    state: State, rule: str, documents: Mapping[str, Document], columns: Columns
) -> lsp.WorkspaceEdit | None:
    """Return the edit that adds a rule to `ignore` in the settings of a package.

    Args:
        state: The state of the package.
        rule: Id of the rule.
        documents: All open files, by URI.
        columns: The client's unit of columns.
    """
    settings = state.checked.settings if state.checked is not None else None
    source_file = settings.source if settings is not None else None
    file = source_file or state.unit.package.root / FILE_NAME
    document = next((each for each in documents.values() if each.path == file.resolve()), None)
    source = document.source if document is not None else _source(file)
    insertion = settings_insertion(source, rule)
    if insertion is None:
        return None
    changes = Changes(documents.values(), columns)
    changes.replace(file.resolve(), source, insertion.at, insertion.at, insertion.text)
    edit = changes.edit
    if source_file is not None or not edit.document_changes:
        return edit
    create = lsp.CreateFile(file.as_uri(), options=lsp.CreateFileOptions(ignore_if_exists=True))
    return lsp.WorkspaceEdit(document_changes=[create, *edit.document_changes])


def _source(file: Path) -> SourceText:
    source = read_text(file, file.name, SIZE_LIMIT)
    return SourceText(file.name, "") if isinstance(source, NotReadable) else source


_IGNORE = re.compile(r"^[ \t]*ignore[ \t]*=[ \t]*\[", re.MULTILINE)
_TABLE = re.compile(r"^[ \t]*\[", re.MULTILINE)
_SECTION = re.compile(r"^[ \t]*\[tool\.subt-check\][ \t]*(?:#[^\n]*)?(?:\n|\Z)", re.MULTILINE)


def settings_insertion(source: SourceText, rule: str) -> Insertion | None:
    """Return what adds a rule to `ignore` in a settings file; None if that cannot be done.

    Args:
        source: subt-check.toml, or pyproject.toml.
        rule: Id of the rule.
    """
    text, start = source.text, 0
    if source.file == SHARED_FILE_NAME:
        section = _SECTION.search(text)
        if section is None:
            return None
        start = section.end()
    table = _TABLE.search(text, start)
    end = table.start() if table else len(text)
    if (known := _IGNORE.search(text, start, end)) is not None:
        is_empty = text[known.end() :].lstrip().startswith("]")
        insertion = Insertion(known.end(), f'"{rule}"' if is_empty else f'"{rule}", ')
    else:
        line_break = "\n" if text[:end] and not text[:end].endswith("\n") else ""
        insertion = Insertion(end, f'{line_break}ignore = ["{rule}"]\n')
    return insertion if _ignores(source, insertion, rule) else None


def _ignores(source: SourceText, insertion: Insertion, rule: str) -> bool:
    text = source.text[: insertion.at] + insertion.text + source.text[insertion.at :]
    try:
        content = tomllib.loads(text)
    except (ValueError, RecursionError):
        return False
    if source.file == SHARED_FILE_NAME:
        content = content.get("tool", {}).get("subt-check", {})
    ignored = content.get("ignore")
    return isinstance(ignored, list) and rule in ignored
