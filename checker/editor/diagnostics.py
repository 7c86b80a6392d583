"""Findings as the diagnostics of open files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from lsprotocol import types as lsp

from checker.base.words import count
from checker.editor.documents import Document
from checker.editor.positions import Columns
from checker.editor.session import State, location_of
from checker.finding import Place, Severity
from checker.package.package import Package
from checker.report.report import ReportedFinding
from checker.report.sarif import help_uri
from checker.source.text import SourceText

SOURCE = "subt-check"
_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
    Severity.INFO: lsp.DiagnosticSeverity.Information,
}
_TAGS = {
    "unused": lsp.DiagnosticTag.Unnecessary,
    "needless": lsp.DiagnosticTag.Unnecessary,
    "deprecated": lsp.DiagnosticTag.Deprecated,
    "classic": lsp.DiagnosticTag.Deprecated,
}
"""Words in the names of rules that editors have a way to show."""
_REASONS_SHOWN = 5


def diagnostics_of(
    document: Document, own: State, others: Iterable[State], columns: Columns
) -> list[lsp.Diagnostic]:
    """Return what an editor shows in an open file.

    Args:
        document: The file.
        own: What is known of the package that it belongs to.
        others: Packages whose rules may find something in it too.
        columns: The client's unit of columns.
    """
    found: dict[tuple[Any, ...], lsp.Diagnostic] = {}
    for state in (own, *others):
        for finding in state.findings:
            for each in _of_finding(finding, state, document, columns):
                start, end = each.range.start, each.range.end
                where = (start.line, start.character, end.line, end.character)
                found.setdefault((*where, each.code, each.message), each)
    return [*found.values(), *_blind_spots(own), *_problem(own, document)]


def _of_finding(
    finding: ReportedFinding, state: State, document: Document, columns: Columns
) -> Iterator[lsp.Diagnostic]:
    if state.checked is None:
        return
    package = state.checked.package
    related = [place for place in finding.places if place.note]
    for place in finding.places:
        if not place.note and location_of(package, place) == document.path:
            message = place.message or finding.message
            yield lsp.Diagnostic(
                range=columns.range_of(document.source, place),
                message=message,
                severity=_SEVERITIES[finding.severity],
                code=finding.rule,
                code_description=lsp.CodeDescription(help_uri(finding.rule)),
                source=SOURCE,
                tags=_tags(finding.name),
                related_information=list(_related(related, package, columns)) or None,
                data={"fingerprint": finding.fingerprint, "rule": finding.rule},
            )


def _tags(name: str) -> list[lsp.DiagnosticTag] | None:
    return [_TAGS[word] for word in name.split("-") if word in _TAGS] or None


def _related(
    places: Sequence[Place], package: Package, columns: Columns
) -> Iterator[lsp.DiagnosticRelatedInformation]:
    for place in places:
        location = location_of(package, place)
        source = package.read(place.file)
        if location is not None and isinstance(source, SourceText):
            where = lsp.Location(location.as_uri(), columns.range_of(source, place))
            yield lsp.DiagnosticRelatedInformation(where, place.note)


def _blind_spots(state: State) -> Iterator[lsp.Diagnostic]:
    """State once, at the top of a file, which rules could not run, and why."""
    spots = state.checked.blind_spots if state.checked is not None else ()
    reasons = dict.fromkeys(spot.reason for spot in spots)
    if reasons:
        rules = count(len({spot.rule for spot in spots}), "rule")
        more = (
            f", and {len(reasons) - _REASONS_SHOWN} more" if len(reasons) > _REASONS_SHOWN else ""
        )
        joined = "; ".join(list(reasons)[:_REASONS_SHOWN])
        yield _at_top(f"{rules} could not run: {joined}{more}", lsp.DiagnosticSeverity.Hint)


def _problem(state: State, document: Document) -> Iterator[lsp.Diagnostic]:
    """Yield why nothing is checked: in the settings that are at fault, and elsewhere as a hint."""
    problem = state.problem
    if problem is not None:
        is_there = problem.path is not None and problem.path.resolve() == document.path
        severity = lsp.DiagnosticSeverity.Error if is_there else lsp.DiagnosticSeverity.Hint
        yield _at_top(problem.message if is_there else f"not checked: {problem.message}", severity)


def _at_top(message: str, severity: lsp.DiagnosticSeverity) -> lsp.Diagnostic:
    start = lsp.Position(0, 0)
    return lsp.Diagnostic(lsp.Range(start, start), message, severity=severity, source=SOURCE)
