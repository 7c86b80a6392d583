"""The commands of the user: a check with weights and trial, the robot in 3D, a drive."""

from __future__ import annotations

import asyncio
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from uuid import uuid4

from lsprotocol import types as lsp

from checker.base.cache import cache_folder
from checker.base.extras import PHYSICS
from checker.base.files import make_folder
from checker.base.output import write
from checker.base.parts import WorkerFailed
from checker.editor.check import is_measured
from checker.editor.full_check import FullCheck
from checker.editor.measured import Measured
from checker.editor.server import Server
from checker.editor.session import Key, Session
from checker.package.package import Package
from checker.pipeline import join_reports
from checker.report.files import PAGE, artefacts
from checker.report.html.overview import trial_sentences
from checker.report.render_settings import Palette, RenderSettings
from checker.report.report import PackageReport
from checker.report.summary import sentence
from checker.rulebook.rule_index import rules

CHECK = "subt-check.server.check"
SHOW = "subt-check.server.show3d"
DRIVE = "subt-check.server.drive"
_LOOKS_SECONDS = 0.1
"""Pause between two checks whether the user has cancelled."""


def register(server: Server) -> None:
    """Add the commands to a server; each is given the URI of a file."""

    @server.command(CHECK)
    async def _(uri: str) -> str | None:
        report = await measure(server, uri)
        return str(sentence(report)) if report is not None else None

    @server.command(SHOW)
    async def _(uri: str) -> dict[str, str] | None:
        report = await measure(server, uri, display=True)
        return await _shown(server, report) if report is not None else None

    @server.command(DRIVE)
    async def _(uri: str) -> str | None:
        report = await measure(server, uri)
        if report is None:
            return None
        result = " ".join(_drives(report))
        server.window_show_message(lsp.ShowMessageParams(lsp.MessageType.Info, result))
        return result


async def measure(server: Server, uri: str, *, display: bool = False) -> PackageReport | None:
    """Check the package of a file with weights and trial, and send the findings to the editor.

    The user sees the progress, and may cancel it.

    Args:
        server: The server of the editor.
        uri: The URI of the file.
        display: Whether the report contains the robot in 3D.

    Returns:
        The report; None if there is none, with a message to the user.
    """
    known = await server.state_of(uri)
    state = known[1] if known is not None else None
    if state is None or state.checked is None:
        problem = state.problem if state is not None else None
        why = problem.message if problem else "the file is not part of a package"
        _complain(server, f"not checked: {why}")
        return None
    if not PHYSICS.is_installed:
        _complain(server, PHYSICS.missing_message)
        return None
    key, checked = state.unit.key, state.checked
    wishes = {"trial": True, "display": True if display else None}
    check = FullCheck(checked.package, checked.settings.with_overrides(**wishes))
    # Results of the earlier text are no longer needed.
    if (earlier := server.measuring.get(key)) is not None:
        earlier.stop()
    server.measuring[key] = check
    done = await _watched(server, check, checked.package.name)
    if server.measuring.get(key) is not check:
        return None
    del server.measuring[key]
    if isinstance(done, WorkerFailed):
        _complain(server, f"the check {done.reason}")
        return None
    await server.read(lambda: _note(server.session, key, checked.package, done))
    await server.publish()
    return done


def _note(session: Session, key: Key, package: Package, report: PackageReport) -> None:
    measured = {rule.id for rule in rules(session.cache) if is_measured(rule)}
    session.note_measured(key, Measured(package, report, measured))


async def _watched(server: Server, check: FullCheck, name: str) -> PackageReport | WorkerFailed:
    """Wait for a check; the editor shows the progress, and may cancel it."""
    window = server.client_capabilities.window
    if window is None or not window.work_done_progress:
        return await asyncio.to_thread(check.result)
    progress, token = server.work_done_progress, str(uuid4())
    await progress.create_async(token)
    progress.begin(token, lsp.WorkDoneProgressBegin(f"{name}: weights and trial", cancellable=True))
    waiting = asyncio.create_task(asyncio.to_thread(check.result))
    try:
        while not (await asyncio.wait([waiting], timeout=_LOOKS_SECONDS))[0]:
            if progress.tokens[token].cancelled():
                check.stop()
        return waiting.result()
    finally:
        progress.end(token, lsp.WorkDoneProgressEnd())
        progress.tokens.pop(token, None)


async def _shown(server: Server, report: PackageReport) -> dict[str, str]:
    """Write the page of a report, and open it in the editor."""
    page = await asyncio.to_thread(_written, report)
    params = lsp.ShowDocumentParams(page.as_uri(), external=True)
    window = server.client_capabilities.window
    if window is not None and window.show_document is not None:
        await server.window_show_document_async(params)
    return {"uri": page.as_uri()}


def _written(report: PackageReport) -> Path:
    folder = cache_folder() / "editor"
    make_folder(folder)
    place = Path(tempfile.mkdtemp(prefix=f"{report.name[:50]}-", dir=folder))
    settings = RenderSettings(Palette(enabled=False), report.path)
    for name, content in artefacts(join_reports([(report,)]), settings):
        write(place / name, content)
    return place / PAGE


def _drives(report: PackageReport) -> Sequence[str]:
    """State the result of the trial."""
    if report.trial is None:
        return ["The robot was not driven: no drive detected."]
    name: Any = report.facts.get("name")
    return trial_sentences(report.trial, str(name or report.name))


def _complain(server: Server, message: str) -> None:
    server.window_show_message(lsp.ShowMessageParams(lsp.MessageType.Warning, message))
