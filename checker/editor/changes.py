"""Edits of files, as the protocol has them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from difflib import SequenceMatcher
from pathlib import Path

from lsprotocol import types as lsp

from checker.editor.documents import Document
from checker.editor.positions import Columns
from checker.finding import Edit
from checker.fix.rounds import FixedFile
from checker.package.package import Package
from checker.source.text import SourceText


class Changes:
    """Edits of some files, which the editor makes together."""

    def __init__(self, documents: Iterable[Document], columns: Columns) -> None:
        """Begin with none.

        Args:
            documents: The documents that are open; an edit of one states which version it is for.
            columns: The client's unit of columns.
        """
        self._versions = {each.path: (each.uri, each.version) for each in documents}
        self._columns = columns
        self._edits: dict[Path, list[lsp.TextEdit | lsp.AnnotatedTextEdit | lsp.SnippetTextEdit]]
        self._edits = defaultdict(list)

    def replace(self, location: Path, source: SourceText, start: int, end: int, text: str) -> None:
        """Put a text in the place of another one."""
        edit = lsp.TextEdit(self._columns.range(source, start, end), text)
        if edit not in self._edits[location]:
            self._edits[location].append(edit)

    def add_edit(self, package: Package, edit: Edit) -> bool:
        """Add an edit of a fix; return whether its file contains what it expects."""
        source, entry = package.read(edit.place.file), package.resolve(edit.place.file)
        if entry is None or not isinstance(source, SourceText):
            return False
        stretch = source.stretch_of(edit)
        if stretch is None:
            return False
        self.replace(entry.location, source, *stretch, edit.replacement)
        return True

    def add_file(self, location: Path, file: FixedFile) -> None:
        """Add what differs between the lines of a file before and after."""
        before = file.before.text.splitlines(keepends=True)
        after = file.after.splitlines(keepends=True)
        starts = [0]
        for line in before:
            starts.append(starts[-1] + len(line))
        matcher = SequenceMatcher(None, before, after, autojunk=False)
        for tag, start, end, new_start, new_end in matcher.get_opcodes():
            if tag != "equal":
                text = "".join(after[new_start:new_end])
                self.replace(location, file.before, starts[start], starts[end], text)

    @property
    def edit(self) -> lsp.WorkspaceEdit:
        """All of them."""
        changes = []
        for location, edits in self._edits.items():
            uri, version = self._versions.get(location, (location.as_uri(), None))
            document = lsp.OptionalVersionedTextDocumentIdentifier(uri, version)
            changes.append(lsp.TextDocumentEdit(document, edits))
        return lsp.WorkspaceEdit(document_changes=changes)
