"""An editor: it talks to a real language server, as a person would have it do."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest_lsp
from lsprotocol import types as lsp

from checker.editor.verdict import VERDICT


class Client(pytest_lsp.LanguageClient):
    """A client that keeps all that it is told of files, in its order."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.published: list[lsp.PublishDiagnosticsParams] = []
        self.verdicts: list[Any] = []
        self.news = asyncio.Event()
        self.versions: dict[str, int] = {}

    def take(self, params: lsp.PublishDiagnosticsParams) -> None:
        self.published.append(params)
        self.news.set()


def client() -> Client:
    """Return a client that takes what a server wants to be told of."""
    made = Client()
    made.feature(lsp.CLIENT_REGISTER_CAPABILITY)(lambda _: None)

    @made.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
    def _(params: lsp.PublishDiagnosticsParams) -> None:
        made.take(params)

    @made.feature(VERDICT)
    def _(params: Any) -> None:
        made.verdicts.append(params)
        made.news.set()

    @made.feature(lsp.WINDOW_SHOW_MESSAGE)
    def _(params: lsp.ShowMessageParams) -> None:
        made.messages.append(params)

    @made.feature(lsp.WINDOW_LOG_MESSAGE)
    def _(params: lsp.LogMessageParams) -> None:
        made.log_messages.append(params)

    @made.feature(lsp.WINDOW_SHOW_DOCUMENT)
    def _(params: lsp.ShowDocumentParams) -> lsp.ShowDocumentResult:
        made.shown_documents.append(params)
        return lsp.ShowDocumentResult(success=True)

    @made.feature(lsp.WINDOW_WORK_DONE_PROGRESS_CREATE)
    def _(params: lsp.WorkDoneProgressCreateParams) -> None:
        made.progress_reports[params.token] = []

    @made.feature(lsp.PROGRESS)
    def _(params: lsp.ProgressParams) -> None:
        made.progress_reports.setdefault(params.token, []).append(params.value)

    return made


SERVER = [sys.executable, "-m", "checker.cli", "server"]
CONFIG = pytest_lsp.ClientServerConfig(server_command=SERVER, client_factory=client)
SECONDS = 30.0
ROVER = "broken_rover_sensor_config_1"
SCOUT = "acme_scout"
"""Samples that the editor has in its folder."""


def capabilities() -> lsp.ClientCapabilities:
    """What a full-grown editor can do."""
    return pytest_lsp.client_capabilities("visual-studio-code")


class Editor:
    """Opens, changes and asks; each open file has a version."""

    def __init__(self, client: Client) -> None:
        self.client = client
        self.versions: dict[str, int] = {}
        self.texts: dict[str, str] = {}

    async def begin(self, *folders: Path, options: Any = None) -> lsp.InitializeResult:
        """Start a session in some folders."""
        return await self.client.initialize_session(
            lsp.InitializeParams(
                capabilities=capabilities(),
                workspace_folders=[lsp.WorkspaceFolder(it.as_uri(), it.name) for it in folders],
                initialization_options=options,
            )
        )

    async def open(self, path: Path, text: str | None = None) -> list[lsp.Diagnostic]:
        """Open a file, and return what is found in it."""
        uri = path.as_uri()
        self.texts[uri] = path.read_text("utf-8") if text is None else text
        self.versions[uri] = self.client.versions[uri] = self.client.versions.get(uri, 0) + 1
        item = lsp.TextDocumentItem(uri, "xml", self.versions[uri], self.texts[uri])
        self.client.text_document_did_open(lsp.DidOpenTextDocumentParams(item))
        return await self.found(path)

    async def change(self, path: Path, text: str) -> list[lsp.Diagnostic]:
        """Change the text of an open file, and return what is found in it then."""
        self.type(path, text)
        return await self.found(path)

    def type(self, path: Path, text: str) -> None:
        """Change the text of an open file, and go on at once."""
        uri = path.as_uri()
        self.texts[uri], self.versions[uri] = text, self.versions[uri] + 1
        self.client.versions[uri] = self.versions[uri]
        self.client.text_document_did_change(
            lsp.DidChangeTextDocumentParams(
                lsp.VersionedTextDocumentIdentifier(uri=uri, version=self.versions[uri]),
                [lsp.TextDocumentContentChangeWholeDocument(text)],
            )
        )

    def text(self, path: Path) -> str:
        """Return the text of an open file."""
        return self.texts[path.as_uri()]

    def save(self, path: Path) -> None:
        """Write an open file."""
        path.write_text(self.texts[path.as_uri()], "utf-8")
        identifier = lsp.TextDocumentIdentifier(path.as_uri())
        self.client.text_document_did_save(lsp.DidSaveTextDocumentParams(identifier))

    def configure(self, settings: Any) -> None:
        """Tell the server of the user's settings."""
        told = lsp.DidChangeConfigurationParams(settings)
        self.client.workspace_did_change_configuration(told)

    async def close(self, path: Path) -> None:
        """Close a file."""
        identifier = lsp.TextDocumentIdentifier(path.as_uri())
        self.client.text_document_did_close(lsp.DidCloseTextDocumentParams(identifier))
        await self.told(lambda params: params.uri == path.as_uri() and params.version is None)
        self.client.published[:] = [p for p in self.client.published if p.uri != path.as_uri()]
        self.client.verdicts[:] = [it for it in self.client.verdicts if it.uri != path.as_uri()]

    async def found(self, path: Path) -> list[lsp.Diagnostic]:
        """Wait for what is found in the present version of a file."""
        version = self.versions[path.as_uri()]
        params = await self.told(
            lambda params: params.uri == path.as_uri() and params.version == version
        )
        return list(params.diagnostics)

    async def told(
        self, fits: Callable[[lsp.PublishDiagnosticsParams], bool]
    ) -> lsp.PublishDiagnosticsParams:
        """Wait until the server has told of something that fits; the newest counts."""
        async with asyncio.timeout(SECONDS):
            while not (found := [it for it in self.client.published if fits(it)]):
                self.client.news.clear()
                await self.client.news.wait()
        return found[-1]

    async def verdict(self, path: Path, fits: Callable[[Any], bool] = lambda _: True) -> Any:
        """Wait until the newest verdict on the package of a file fits, and return it."""
        async with asyncio.timeout(SECONDS):
            while True:
                found = [it for it in self.client.verdicts if it.uri == path.as_uri()]
                if found and fits(found[-1]):
                    return found[-1]
                self.client.news.clear()
                await self.client.news.wait()

    async def actions(
        self, path: Path, diagnostics: Sequence[lsp.Diagnostic], only: list[str] | None = None
    ) -> list[lsp.CodeAction]:
        """Return what can be done."""
        at = diagnostics[0].range if diagnostics else lsp.Range(*[lsp.Position(0, 0)] * 2)
        found = await self.client.text_document_code_action_async(
            lsp.CodeActionParams(
                lsp.TextDocumentIdentifier(path.as_uri()),
                at,
                lsp.CodeActionContext(diagnostics, only=only),
            )
        )
        return [each for each in found or () if isinstance(each, lsp.CodeAction)]

    def where(self, path: Path, needle: str, into: int = 0) -> dict[str, Any]:
        """Return a file and the position of a text in it, as requests take them."""
        text = self.text(path)
        offset = text.index(needle) + into
        line = text.count("\n", 0, offset)
        before = text[text.rfind("\n", 0, offset) + 1 : offset]
        position = lsp.Position(line, len(before.encode("utf-16-le")) // 2)
        return {
            "text_document": lsp.TextDocumentIdentifier(path.as_uri()),
            "position": position,
        }

    def applied(self, edit: lsp.WorkspaceEdit | None) -> dict[str, str]:
        """Return the texts that an edit changes, as they are then."""
        changed = {}
        for change in (edit.document_changes if edit else None) or ():
            if isinstance(change, lsp.TextDocumentEdit):
                uri = change.text_document.uri
                before = self.texts.get(uri)
                if before is None:
                    path = Path(uri.removeprefix("file://"))
                    before = path.read_text("utf-8") if path.exists() else ""
                changed[uri] = edited(before, change.edits)
        return changed


def edited(text: str, edits: Sequence[Any]) -> str:
    """Return a text after edits."""
    stretches = sorted((at(text, e.range.start), at(text, e.range.end), e.new_text) for e in edits)
    for start, end, new in reversed(stretches):
        text = text[:start] + new + text[end:]
    return text


def at(text: str, position: lsp.Position) -> int:
    """Return the offset of a position that is counted in UTF-16."""
    lines = text.split("\n")
    before = sum(len(line) + 1 for line in lines[: position.line])
    units = lines[position.line].encode("utf-16-le")[: 2 * position.character]
    return before + len(units.decode("utf-16-le"))


def shown(diagnostics: Sequence[lsp.Diagnostic]) -> set[tuple[Any, ...]]:
    """Return diagnostics as values that can be compared."""
    return {(d.range.start.line + 1, d.code, d.message) for d in diagnostics if d.code}
