"""Lines above a model: its mass, the verdict, and commands."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from checker.base.parts import NotAvailable
from checker.editor.commands import CHECK, DRIVE, SHOW
from checker.editor.documents import Document
from checker.editor.positions import Columns
from checker.editor.session import State, path_in
from checker.model.robot import Robot
from checker.report.report import PackageReport
from checker.report.summary import sentence


def lenses_of(document: Document, state: State, columns: Columns) -> list[lsp.CodeLens]:
    """Return the lenses of a file: those of each robot that begins in it.

    Args:
        document: The file.
        state: The state of its package.
        columns: The client's unit of columns.
    """
    checked = state.checked
    if checked is None:
        return []
    robots = checked.subject.all(Robot)
    path = path_in(checked.package, document.path)
    lenses = []
    for robot in () if isinstance(robots, NotAvailable) else robots:
        place = robot.span.place()
        if place.file == path:
            at = columns.range_of(document.source, place)
            lenses += [
                lsp.CodeLens(lsp.Range(at.start, at.start), command)
                for command in _commands(robot, state, document.uri)
            ]
    return lenses


def _commands(robot: Robot, state: State, uri: str) -> Iterator[lsp.Command]:
    yield lsp.Command(f"{robot.mass:.4g} kg · {_verdict(state)}", CHECK, arguments=[uri])
    yield lsp.Command("show in 3D", SHOW, arguments=[uri])
    yield lsp.Command("drive it", DRIVE, arguments=[uri])


def _verdict(state: State) -> str:
    """Return the verdict of the rules that have run."""
    checked = state.checked
    if checked is None:
        return ""
    package, outcome = checked.package, checked.outcome
    report = PackageReport(
        package.name, str(package.root), str(package.kind), state.findings, outcome.not_checked
    )
    verdict = sentence(report)
    return f"{verdict.lead}: {verdict.rest}"
