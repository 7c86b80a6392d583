"""Quick fixes: the fixes of findings, suppressions with a reason, and rules to switch off."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from lsprotocol import types as lsp

from checker.base.words import shortened
from checker.editor.changes import Changes
from checker.editor.documents import Document
from checker.editor.positions import Columns
from checker.editor.server import Server
from checker.editor.session import State, path_in
from checker.editor.suppression import reason_comment, rule_switched_off
from checker.finding import Edit, Fix, Safety
from checker.fix.rounds import FixedFile, fix_package
from checker.package.package import Package
from checker.report.report import ReportedFinding

FIX_ALL = "source.fixAll.subt-check"
_SHOWN = 40
"""Characters of a text that a title shows."""


def wanted(
    server: Server, document: Document, state: State, context: lsp.CodeActionContext
) -> list[lsp.CodeAction]:
    """Return what a client asks for."""
    kinds = context.only or [lsp.CodeActionKind.QuickFix]
    documents, columns = server.session.documents, server.columns
    found: list[lsp.CodeAction] = []
    if any(lsp.CodeActionKind.QuickFix.startswith(kind) for kind in kinds):
        found += actions_for(state, document, context.diagnostics, documents, columns)
    if any(FIX_ALL.startswith(kind) for kind in kinds) and (every := _all(server, document, state)):
        found.append(every)
    return found


def _all(server: Server, document: Document, state: State) -> lsp.CodeAction | None:
    """Return what makes the safe fixes of a file; what other files have a part in is left alone."""
    if state.checked is None:
        return None
    package, judge, session = state.checked.package, server.session.judge(state), server.session
    path = path_in(package, document.path)

    def findings_here(edited: Package) -> tuple[ReportedFinding, ...]:
        found = ((each, each.fix.edits if each.fix else ()) for each in judge(edited))
        return tuple(each for each, edits in found if {e.place.file for e in edits} == {path})

    fixed = fix_package(package, findings_here, [Safety.SAFE])
    return fix_all(package, fixed.files, session.documents, server.columns)


def actions_for(
    state: State,
    document: Document,
    diagnostics: Sequence[lsp.Diagnostic],
    documents: Mapping[str, Document],
    columns: Columns,
) -> list[lsp.CodeAction]:
    """Return what can be done about diagnostics of a file.

    Args:
        state: Of its package.
        document: The file.
        diagnostics: Those that the user points at.
        documents: All open files, by URI.
        columns: How the client counts.
    """
    if state.checked is None:
        return []
    package, known = state.checked.package, {each.fingerprint: each for each in state.findings}
    actions: list[lsp.CodeAction] = []
    for diagnostic in diagnostics:
        data = diagnostic.data if isinstance(diagnostic.data, dict) else {}
        finding = known.get(str(data.get("fingerprint")))
        if finding is not None:
            actions += _fixes(finding, diagnostic, package, documents, columns)
            actions += _suppressions(finding, diagnostic, state, document, documents, columns)
    return actions


def _fixes(
    finding: ReportedFinding,
    diagnostic: lsp.Diagnostic,
    package: Package,
    documents: Mapping[str, Document],
    columns: Columns,
) -> Iterator[lsp.CodeAction]:
    """Yield what fixes a finding here, and what fixes it in all of its places."""
    here = _fix_here(finding, diagnostic)
    for fix in dict.fromkeys(filter(None, (here, finding.fix))):
        changes = Changes(documents.values(), columns)
        if all(changes.add_edit(package, edit) for edit in fix.edits):
            is_safe = fix.safety is Safety.SAFE
            yield lsp.CodeAction(
                title=_title(finding, fix.edits) + ("" if is_safe else " (changes behaviour)"),
                kind=lsp.CodeActionKind.QuickFix,
                diagnostics=[diagnostic],
                is_preferred=is_safe and fix is (here or finding.fix),
                edit=changes.edit,
            )


def _fix_here(finding: ReportedFinding, diagnostic: lsp.Diagnostic) -> Fix | None:
    """Return the fix of the one place that a diagnostic shows."""
    first, last = diagnostic.range.start.line + 1, diagnostic.range.end.line + 1
    file = next((place.file for place in finding.places if place.line == first), "")
    for fix in finding.fixes:
        if any(e.place.file == file and first <= e.place.line <= last for e in fix.edits):
            return fix
    return None


def _title(finding: ReportedFinding, edits: Sequence[Edit]) -> str:
    """Say what a fix does, if it is one short edit; else which fault it mends."""
    if len(edits) == 1 and "\n" not in edits[0].original + edits[0].replacement:
        old, new = (shortened(text, _SHOWN) for text in (edits[0].original, edits[0].replacement))
        if old and new:
            return f"{finding.rule}: replace '{old}' with '{new}'"
        return f"{finding.rule}: insert '{new}'" if new else f"{finding.rule}: remove '{old}'"
    places = f" in {len(edits)} places" if len(edits) > 1 else ""
    return f"{finding.rule}: fix {finding.name}{places}"


def _suppressions(
    finding: ReportedFinding,
    diagnostic: lsp.Diagnostic,
    state: State,
    document: Document,
    documents: Mapping[str, Document],
    columns: Columns,
) -> Iterator[lsp.CodeAction]:
    line = diagnostic.range.start.line + 1
    if (comment := reason_comment(document.source, finding.rule, line)) is not None:
        changes = Changes(documents.values(), columns)
        changes.replace(document.path, document.source, comment.at, comment.at, comment.text)
        yield lsp.CodeAction(
            title=f"{finding.rule}: suppress here (write the reason)",
            kind=lsp.CodeActionKind.QuickFix,
            diagnostics=[diagnostic],
            edit=changes.edit,
        )
    if (edit := rule_switched_off(state, finding.rule, documents, columns)) is not None:
        yield lsp.CodeAction(
            title=f"{finding.rule}: switch off in the settings",
            kind=lsp.CodeActionKind.QuickFix,
            diagnostics=[diagnostic],
            edit=edit,
        )


def fix_all(
    package: Package,
    files: Iterable[FixedFile],
    documents: Mapping[str, Document],
    columns: Columns,
) -> lsp.CodeAction | None:
    """Return what makes safe fixes; None where there are none.

    Args:
        package: With the texts of the editor.
        files: What the fixes come to.
        documents: All open files, by URI.
        columns: How the client counts.
    """
    changes = Changes(documents.values(), columns)
    count = 0
    for file in files:
        if (entry := package.index.find(file.path)) is not None:
            changes.add_file(entry.location, file)
            count += 1
    if not count:
        return None
    return lsp.CodeAction("Fix all in this file (safe fixes)", kind=FIX_ALL, edit=changes.edit)
