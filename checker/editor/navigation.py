"""Names in the terms of the protocol: definitions, references, new names, outlines and folds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lsprotocol import types as lsp

from checker.editor.changes import Changes
from checker.editor.documents import Document
from checker.editor.names.folding import folds_of
from checker.editor.names.index import NameIndex
from checker.editor.names.mention import Mention
from checker.editor.names.outline.symbol import Symbol, SymbolKind
from checker.editor.names.symbols import symbols_of
from checker.editor.positions import Columns
from checker.editor.session import path_in
from checker.package.package import Package
from checker.source.text import SourceText

_KINDS = {
    SymbolKind.ROBOT: lsp.SymbolKind.Class,
    SymbolKind.WORLD: lsp.SymbolKind.Namespace,
    SymbolKind.MODEL: lsp.SymbolKind.Class,
    SymbolKind.LINK: lsp.SymbolKind.Object,
    SymbolKind.JOINT: lsp.SymbolKind.Interface,
    SymbolKind.FRAME: lsp.SymbolKind.Constant,
    SymbolKind.SENSOR: lsp.SymbolKind.Event,
    SymbolKind.PLUGIN: lsp.SymbolKind.Module,
    SymbolKind.INCLUDE: lsp.SymbolKind.File,
    SymbolKind.MACRO: lsp.SymbolKind.Function,
    SymbolKind.PROPERTY: lsp.SymbolKind.Property,
    SymbolKind.ARGUMENT: lsp.SymbolKind.Variable,
    SymbolKind.NODE: lsp.SymbolKind.Object,
    SymbolKind.KEY: lsp.SymbolKind.Key,
    SymbolKind.FUNCTION: lsp.SymbolKind.Function,
    SymbolKind.CLASS: lsp.SymbolKind.Class,
}


class Navigator:
    """The names of a package, for requests from one of its files."""

    def __init__(self, index: NameIndex, document: Document, columns: Columns) -> None:
        """Take the names.

        Args:
            index: The index of the package.
            document: The file.
            columns: The client's unit of columns.
        """
        self._index, self._columns = index, columns
        self._package = index.package
        self._path = path_in(self._package, document.path)

    def definitions(self, position: lsp.Position) -> list[lsp.Location]:
        """Return where the thing at a position is made."""
        mention = self._mention_at(position)
        return list(self._locations(self._index.definitions(mention))) if mention else []

    def references(self, position: lsp.Position, *, definitions: bool) -> list[lsp.Location]:
        """Return where the thing at a position is named, also where it is made if wanted."""
        mention = self._mention_at(position)
        found = self._index.references(mention) if mention else ()
        made = self._index.definitions(mention) if mention and not definitions else ()
        return list(self._locations(each for each in found if each not in made))

    def range(self, position: lsp.Position) -> lsp.Range | None:
        """Return the range of the name at a position; None if none can be changed."""
        mention = self._mention_at(position)
        source = self._source(mention.path) if mention else None
        if mention is None or source is None:
            return None
        return self._columns.range(source, mention.start, mention.end)

    def rename(
        self, position: lsp.Position, new: str, documents: Iterable[Document]
    ) -> lsp.WorkspaceEdit | str:
        """Return what names the thing at a position otherwise, or why it cannot be."""
        mention = self._mention_at(position)
        if mention is None:
            return "there is no name here that can be changed"
        edits = self._index.rename(mention, new)
        if isinstance(edits, str):
            return edits
        changes = Changes(documents, self._columns)
        for edit in edits:
            if not changes.add_edit(self._package, edit):
                return f"{edit.place.file} has changed; try again"
        return changes.edit

    def _mention_at(self, position: lsp.Position) -> Mention | None:
        source = self._source(self._path)
        if source is None:
            return None
        return self._index.at(self._path, self._columns.offset(source, position))

    def _locations(self, mentions: Iterable[Mention]) -> Iterator[lsp.Location]:
        for mention in mentions:
            source, entry = self._source(mention.path), self._package.resolve(mention.path)
            if source is not None and entry is not None:
                where = self._columns.range(source, mention.start, mention.end)
                yield lsp.Location(entry.location.as_uri(), where)

    def _source(self, path: str) -> SourceText | None:
        source = self._package.read(path) if path else None
        return source if isinstance(source, SourceText) else None


def outline(package: Package, document: Document, columns: Columns) -> list[lsp.DocumentSymbol]:
    """Return the symbols of a file as a tree; links stand as the robot is built of them."""
    path = path_in(package, document.path)
    source = package.read(path) if path else document.source
    if not isinstance(source, SourceText):
        return []
    return [_symbol(each, source, columns) for each in symbols_of(package, path)]


def _symbol(symbol: Symbol, source: SourceText, columns: Columns) -> lsp.DocumentSymbol:
    children = [_symbol(each, source, columns) for each in symbol.children]
    # Editors want the name within the symbol, and look for the caret from the outside in.
    start, end = min(symbol.start, symbol.name_start), max(symbol.end, symbol.name_end)
    return lsp.DocumentSymbol(
        name=symbol.name or "?",
        kind=_KINDS[symbol.kind],
        range=columns.range(source, start, end),
        selection_range=columns.range(source, symbol.name_start, symbol.name_end),
        detail=symbol.detail or None,
        children=children,
    )


def folds(document: Document) -> list[lsp.FoldingRange]:
    """Return what may be folded in a file."""
    return [
        lsp.FoldingRange(fold.start_line - 1, fold.end_line - 1, kind=str(fold.kind))
        for fold in folds_of(document.source)
    ]
