"""Hovers and completions in the terms of the protocol."""

from __future__ import annotations

from collections.abc import Sequence

from lsprotocol import types as lsp

from checker.editor.check import Checked
from checker.editor.completion.completion import completions_at
from checker.editor.completion.item import Completion, CompletionKind
from checker.editor.documents import Document
from checker.editor.hover.hover import hover_at
from checker.editor.hover.rule_pages import rule_page_markdown
from checker.editor.positions import Columns
from checker.editor.session import Session, State, path_in
from checker.rule import Context, Rule
from checker.rulebook.discovery import all_rules

_KINDS = {
    CompletionKind.ELEMENT: lsp.CompletionItemKind.Class,
    CompletionKind.ATTRIBUTE: lsp.CompletionItemKind.Property,
    CompletionKind.VALUE: lsp.CompletionItemKind.EnumMember,
    CompletionKind.LINK: lsp.CompletionItemKind.Reference,
    CompletionKind.JOINT: lsp.CompletionItemKind.Reference,
    CompletionKind.FRAME: lsp.CompletionItemKind.Reference,
    CompletionKind.SENSOR: lsp.CompletionItemKind.Reference,
    CompletionKind.MODEL: lsp.CompletionItemKind.Reference,
    CompletionKind.PLUGIN: lsp.CompletionItemKind.Module,
    CompletionKind.PARAMETER: lsp.CompletionItemKind.Field,
    CompletionKind.MACRO: lsp.CompletionItemKind.Function,
    CompletionKind.PROPERTY: lsp.CompletionItemKind.Constant,
    CompletionKind.ARGUMENT: lsp.CompletionItemKind.Variable,
    CompletionKind.PACKAGE: lsp.CompletionItemKind.Module,
    CompletionKind.FOLDER: lsp.CompletionItemKind.Folder,
    CompletionKind.FILE: lsp.CompletionItemKind.File,
}
LIMIT = 500
"""Items of a list; a longer list is requested again while the user types."""


def hover(
    session: Session, document: Document, state: State, position: lsp.Position, columns: Columns
) -> lsp.Hover | None:
    """Return what is shown at a position: the pages of rules that find something there, and more.

    Args:
        session: The session with the packages.
        document: The file.
        state: The state of its package.
        position: The user's position.
        columns: The client's unit of columns.
    """
    checked = state.checked
    path = path_in(checked.package, document.path) if checked is not None else ""
    if checked is None or not path:
        return None
    offset, where = columns.offset(document.source, position), None
    pages = [rule_page_markdown(rule) for rule in _rules_at(state, document, path, offset)]
    # Offsets of a text that is no XML just now are not those of its last good one.
    legible = session.legible(checked) is checked.subject
    found = hover_at(checked.subject, path, offset, target_of(checked)) if legible else None
    if found is not None:
        pages.append(found.markdown)
        where = columns.range(document.source, found.start, found.end)
    if not pages:
        return None
    return lsp.Hover(lsp.MarkupContent(lsp.MarkupKind.Markdown, "\n\n---\n\n".join(pages)), where)


def _rules_at(state: State, document: Document, path: str, offset: int) -> list[Rule]:
    """Return the rules that find something at an offset."""
    line, column = document.source.position(offset)
    found = {
        finding.rule
        for finding in state.findings
        for place in finding.places
        if place.file == path
        and not place.note
        and (place.line, place.column) <= (line, column) <= (place.end_line, place.end_column)
    }
    return [rule for rule in all_rules() if rule.id in found] if found else []


def completions(
    session: Session,
    document: Document,
    checked: Checked,
    position: lsp.Position,
    columns: Columns,
    *,
    snippets: bool,
) -> lsp.CompletionList:
    """Return what may be written at a position.

    Args:
        session: The session with the packages.
        document: The file as it is now.
        checked: What is known of its package.
        position: The position of the caret.
        columns: The client's unit of columns.
        snippets: Whether the client can fill in places of a text.
    """
    path = path_in(checked.package, document.path)
    found: Sequence[Completion] = ()
    if path and document.is_xml:
        subject, offset = session.legible(checked), columns.offset(document.source, position)
        found = completions_at(subject, path, document.text, offset, target_of(checked))
    usable = [each for each in found if snippets or not each.is_snippet]
    items = [_item(each, document, columns) for each in usable[:LIMIT]]
    return lsp.CompletionList(is_incomplete=len(usable) > LIMIT, items=items)


def target_of(checked: Checked) -> Context:
    """Return what a package is judged for."""
    return checked.settings.judge_profile.context


def _item(found: Completion, document: Document, columns: Columns) -> lsp.CompletionItem:
    where = columns.range(document.source, found.start, found.end)
    text = lsp.MarkupContent(lsp.MarkupKind.Markdown, found.documentation)
    formats = lsp.InsertTextFormat
    return lsp.CompletionItem(
        label=found.label,
        kind=_KINDS[found.kind],
        detail=found.detail or None,
        documentation=text if found.documentation else None,
        sort_text=found.sort,
        filter_text=found.label,
        insert_text_format=formats.Snippet if found.is_snippet else formats.PlainText,
        text_edit=lsp.TextEdit(where, found.insert),
    )
