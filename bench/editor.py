"""Measure how soon an editor shows the findings of a change, and what the server uses.

`python -m bench.editor`, with SUBT_CHECK_CORPUS and SUBT_CHECK_MODERN. A real language server is
sent one change after the other, each of another number; the time is measured until its findings
for that text arrive. Machines differ and are shared: the limits are meant for two quiet cores.
"""

from __future__ import annotations

import asyncio
import os
import re
import shutil
import statistics
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from time import perf_counter

from lsprotocol import types as lsp
from pygls.lsp.client import LanguageClient

from bench.static import keep_bytecode

CHANGES = 60
MODEL = "cerberus_anymal_c_sensor_config_1/model.sdf"
"""The longest model of the corpus."""
ROBOT = "irobot_create_common/irobot_create_description/urdf/create3.urdf.xacro"
"""The xacro robot of the package that expands to the most elements."""
REPOSITORY = "create3_sim"
LIMITS = {"model.sdf": 150.0, "xacro": 400.0, "memory": 300.0}
"""Milliseconds at the 95th percentile; megabytes."""
_SECONDS = 120.0
_NUMBER = re.compile(r"[0-9]\.[0-9]+")


class Editor:
    """A client that waits for findings."""

    def __init__(self) -> None:
        self._client = LanguageClient("bench", "1")
        self._news = asyncio.Event()
        self._versions: dict[str, int | None] = {}

        @self._client.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        def _(params: lsp.PublishDiagnosticsParams) -> None:
            self._versions[params.uri] = params.version
            self._news.set()

    async def start(self, folder: Path) -> None:
        """Start a server for a folder."""
        await self._client.start_io(sys.executable, "-m", "checker.cli", "server")
        folders = [lsp.WorkspaceFolder(folder.as_uri(), folder.name)]
        capabilities = lsp.ClientCapabilities()
        await self._client.initialize_async(
            lsp.InitializeParams(capabilities, workspace_folders=folders)
        )
        self._client.initialized(lsp.InitializedParams())

    async def open(self, path: Path) -> float:
        """Open a file, and return the seconds until its findings are there."""
        item = lsp.TextDocumentItem(path.as_uri(), "xml", 1, path.read_text("utf-8"))
        started = perf_counter()
        self._client.text_document_did_open(lsp.DidOpenTextDocumentParams(item))
        await self._told(path, 1)
        return perf_counter() - started

    async def change(self, path: Path, text: str, version: int) -> float:
        """Change a file, and return the seconds until the findings of that text are there."""
        identifier = lsp.VersionedTextDocumentIdentifier(uri=path.as_uri(), version=version)
        change = lsp.TextDocumentContentChangeWholeDocument(text)
        started = perf_counter()
        self._client.text_document_did_change(lsp.DidChangeTextDocumentParams(identifier, [change]))
        await self._told(path, version)
        return perf_counter() - started

    async def _told(self, path: Path, version: int) -> None:
        async with asyncio.timeout(_SECONDS):
            while self._versions.get(path.as_uri()) != version:
                self._news.clear()
                await self._news.wait()

    @property
    def megabytes(self) -> tuple[float, float]:
        """Memory of the server, alone and with all processes that it has started."""
        server = self._client._server
        assert server is not None
        every = [server.pid, *_descendants(server.pid)]
        held = [_resident(pid) for pid in every]
        return held[0], sum(held)

    async def end(self) -> None:
        """End the server."""
        await self._client.shutdown_async(None)
        self._client.exit(None)
        await self._client.stop()


def _resident(pid: int) -> float:
    """Return the megabytes of a process, its share of memory that several processes use."""
    try:
        lines = Path(f"/proc/{pid}/smaps_rollup").read_text("ascii").splitlines()
    except OSError:
        return 0.0
    return next(float(line.split()[1]) for line in lines if line.startswith("Pss:")) / 1e3


def _descendants(pid: int) -> Iterator[int]:
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        for child in map(int, task.read_text("ascii").split()):
            yield child
            yield from _descendants(child)


def numbered(text: str, number: int) -> str:
    """Return a text with another number in the middle of it, as if a user typed digits."""
    found = _NUMBER.search(text, len(text) // 3)
    assert found is not None
    return f"{text[: found.end()]}{number}{text[found.end() :]}"


def show(name: str, times: Sequence[float], opened: float) -> None:
    """Print the median and the 95th percentile with their limit."""
    told = sorted(1e3 * each for each in times)
    p95 = told[min(len(told) - 1, round(0.95 * len(told)))]
    fits = "yes" if p95 <= LIMITS[name] else "NO"
    print(
        f"{name:<10} opened in {opened:5.2f} s, change: median {statistics.median(told):5.0f} ms, "
        f"p95 {p95:5.0f} ms  (≤ {LIMITS[name]:g}: {fits})",
        flush=True,
    )


async def changes(name: str, folder: Path, path: Path) -> None:
    """Measure changes of one file."""
    editor, text = Editor(), path.read_text("utf-8")
    await editor.start(folder)
    opened = await editor.open(path)
    times = [await editor.change(path, numbered(text, n), n) for n in range(2, CHANGES + 2)]
    show(name, times[3:], opened)
    await editor.end()


async def memory(folder: Path) -> None:
    """Measure what a workspace needs of which every package is open and was changed once."""
    editor = Editor()
    await editor.start(folder)
    models = sorted(path for path in folder.glob("*/model.sdf") if path.is_file())
    for path in models:
        await editor.open(path)
        await editor.change(path, path.read_text("utf-8") + "\n", 2)
    own, every = editor.megabytes
    fits = "yes" if every <= LIMITS["memory"] else "NO"
    packages = sum(1 for each in folder.iterdir() if each.is_dir())
    print(
        f"memory     {packages} packages, {len(models)} models open: server {own:.0f} MB, with its "
        f"processes {every:.0f} MB  (≤ {LIMITS['memory']:g}: {fits})"
    )
    await editor.end()


def main() -> None:
    """Measure and print everything."""
    keep_bytecode()
    corpus, modern = (os.environ.get(f"SUBT_CHECK_{name}", "") for name in ("CORPUS", "MODERN"))
    if not (corpus and modern):
        print("SUBT_CHECK_CORPUS and SUBT_CHECK_MODERN name real packages: not all is measured")
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder).resolve()
        if corpus:
            copy = Path(shutil.copytree(corpus, place / "corpus", symlinks=True))
            asyncio.run(changes("model.sdf", copy, copy / MODEL))
            asyncio.run(memory(copy))
        if modern:
            copy = Path(shutil.copytree(Path(modern, REPOSITORY), place / REPOSITORY))
            asyncio.run(changes("xacro", copy, copy / ROBOT))


if __name__ == "__main__":
    main()
