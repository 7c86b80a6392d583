"""The language server: the time of checks, and messages without a request.

All packages are read in one thread, one after the other; the event loop serves the
editor meanwhile. A check begins as soon as a text changes. Changes that come while it runs are
checked together when it ends.
"""

from __future__ import annotations

import asyncio
import gc
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, TypeVar

from lsprotocol import types as lsp
from pygls.lsp.server import LanguageServer

from checker.base.resources import tool_version
from checker.base.words import plain, shortened
from checker.editor.diagnostics import diagnostics_of
from checker.editor.documents import Document, path_of
from checker.editor.full_check import FullCheck
from checker.editor.positions import Columns
from checker.editor.session import Key, Session, State
from checker.editor.verdict import VERDICT, Verdict, verdict_of

T = TypeVar("T")
_PAUSE_SECONDS = 0.02
"""Pause between a change and its check: keys that are pressed together are checked together."""
_QUIET_SECONDS = 0.5
"""Without a change, after which what old checks have left is collected."""
_CHECKS_LEFT = 25
"""Number of checks after which garbage is collected without a pause; each leaves some 4 MB."""


class Server(LanguageServer):
    """Language server for one editor.

    Attributes:
        session: The state of the packages.
        columns: The client's unit of columns.
        measures_on_save: Whether weights are taken and the trial is run when a file is saved.
        sends_verdicts: Whether the client shows verdicts on packages.
        measuring: Running checks with weights and trial, by what they check.
    """

    def __init__(self) -> None:
        super().__init__(
            "subt-check", tool_version(), text_document_sync_kind=lsp.TextDocumentSyncKind.Full
        )
        self.session = Session()
        self.columns = Columns()
        self.measures_on_save = False
        self.sends_verdicts = False
        self.measuring: dict[Key, FullCheck] = {}
        self._pause = _PAUSE_SECONDS
        self._reader = ThreadPoolExecutor(1, "reader")
        self._is_stale = False
        self._checking: asyncio.Task[None] | None = None
        self._collecting: asyncio.TimerHandle | None = None
        self._checks = 0

    def begin(self, params: lsp.InitializeParams) -> None:
        """Take over what the client states about itself."""
        folders = [folder.uri for folder in params.workspace_folders or ()]
        self.session.units.folders = real_folders(folders or [params.root_uri or ""])
        self.columns = Columns(
            lsp.PositionEncodingKind(self.workspace.position_encoding or "utf-16")
        )
        options = params.initialization_options
        self.sends_verdicts = isinstance(options, dict) and options.get("verdict") is True
        self.configure(options)

    def configure(self, options: Any) -> None:
        """Read the user's settings of the editor; values of another form are ignored."""
        if isinstance(options, dict):
            self.measures_on_save = options.get("trial") == "save"
            if isinstance(pause := options.get("debounce"), int | float):
                self._pause = min(max(float(pause) / 1000.0, 0.0), 5.0)

    @property
    def takes_snippets(self) -> bool:
        """True if the client can fill in places of a text that it completes."""
        document = self.client_capabilities.text_document
        items = document.completion.completion_item if document and document.completion else None
        return bool(items and items.snippet_support)

    async def read(self, work: Callable[[], T]) -> T:
        """Run a function in the thread that reads packages."""
        return await asyncio.get_running_loop().run_in_executor(self._reader, work)

    async def state_of(self, uri: str) -> tuple[Document, State] | None:
        """Return an open file and what is known of its package; None outside of packages."""
        document = self.session.documents.get(uri)
        if document is None:
            return None
        state = await self.read(lambda: self.session.state_of(document.path))
        return (document, state) if state is not None else None

    def check_soon(self) -> None:
        """Check the packages of open files; unchanged ones take no time."""
        self._is_stale = True
        if self._checking is None or self._checking.done():
            self._checking = asyncio.get_running_loop().create_task(self._check())

    def reread(self, change: Callable[[], None]) -> None:
        """Have packages checked after a change of what is known of the disk.

        Args:
            change: Makes it, in the thread that reads packages.
        """
        self._reader.submit(change)
        self.check_soon()

    async def _check(self) -> None:
        await asyncio.sleep(self._pause)
        while self._is_stale:
            self._is_stale = False
            try:
                await self.read(self.session.check_all)
                await self.publish()
            except Exception as error:  # noqa: BLE001 - the next change is checked anyway
                self._apologise(error)
            self._collect_later()

    def _apologise(self, error: Exception) -> None:
        problem = plain(shortened(f"{type(error).__name__}: {error}", 300))
        message = f"subt-check: internal error ({problem}); please report it"
        self.window_log_message(lsp.LogMessageParams(lsp.MessageType.Error, message))

    def _collect_later(self) -> None:
        """Collect garbage when the user does not type: during checks, it takes half their time."""
        if self._collecting is not None:
            self._collecting.cancel()
        self._checks += 1
        if self._checks >= _CHECKS_LEFT:
            self._collect()
        else:
            loop = asyncio.get_running_loop()
            self._collecting = loop.call_later(_QUIET_SECONDS, self._collect)

    def _collect(self) -> None:
        self._checks = 0
        self._reader.submit(_collect_but_programs)

    async def publish(self) -> None:
        """Tell the editor what is found in the open files."""

        def compute() -> list[tuple[Document, list[lsp.Diagnostic] | None]]:
            every = self.session.documents.values()
            return [(document, self._diagnostics(document)) for document in list(every)]

        for document, diagnostics in await self.read(compute):
            # The next check reports on a text that has changed meanwhile.
            if diagnostics is not None and self.session.documents.get(document.uri) is document:
                params = lsp.PublishDiagnosticsParams(document.uri, diagnostics, document.version)
                self.text_document_publish_diagnostics(params)
        if self.sends_verdicts:
            for uri, verdict in (await self.read(self._verdicts)).items():
                self.protocol.notify(VERDICT, {"uri": uri, **verdict})

    def _verdicts(self) -> dict[str, Verdict]:
        """Return the verdict on the package of each open file."""
        documents = list(self.session.documents.values())
        states = {each.uri: self.session.state_of(each.path) for each in documents}
        verdicts = {state: verdict_of(state) for state in set(states.values())}
        return {uri: verdicts[state] for uri, state in states.items()}

    def _diagnostics(self, document: Document) -> list[lsp.Diagnostic] | None:
        """Return what is found in a file; None if another text of it was checked."""
        own = self.session.state_of(document.path)
        if own is None:
            return []
        if not own.is_of(document):
            return None
        others = [state for state in self.session.states if state.unit.key != own.unit.key]
        return diagnostics_of(document, own, others, self.columns)

    def end(self) -> None:
        """End what was started."""
        for check in self.measuring.values():
            check.stop()
        self.session.close()
        self._reader.shutdown(wait=False, cancel_futures=True)


def _collect_but_programs() -> None:
    """Collect the garbage of checks; modules and rules, which are most objects, are skipped."""
    gc.collect()
    if not gc.get_freeze_count():
        gc.freeze()


def real_folders(uris: Iterable[str]) -> tuple[Path, ...]:
    """Return the folders of URIs, the innermost first."""
    found = {path for uri in uris if uri and (path := path_of(uri)) is not None and path.is_dir()}
    return tuple(sorted(found, key=lambda path: (-len(path.parts), path)))
