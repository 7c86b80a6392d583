"""Quick fixes: the fixes of findings, suppressions with a reason, and rules to switch off."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lsprotocol import types as lsp

from checker.base.words import shortened
from checker.editor.changes import Changes
from checker.editor.check import Checked
from checker.editor.documents import Document
from checker.editor.server import Server
from checker.editor.session import State, path_in
from checker.editor.suppression import reason_comment, rule_switched_off
from checker.finding import Edit, Fix, Safety
from checker.fix.rounds import fix_package
from checker.package.package import Package
from checker.report.report import ReportedFinding

FIX_ALL = "source.fixAll.subt-check"
_SHOWN = 40
"""Characters of a text that a title shows."""


def code_actions(
    server: Server, document: Document, state: State, context: lsp.CodeActionContext
) -> list[lsp.CodeAction]:
    """Return the actions that a client requests.

    Args:
        server: The server of the editor.
        document: The file.
        state: The state of its package.
        context: The user's selection, and the requested kinds of actions.
    """
    if state.checked is None:
        return []
    kinds = context.only or [lsp.CodeActionKind.QuickFix]
    offer = _Offer(server, document, state, state.checked)
    found: list[lsp.CodeAction] = []
    if any(lsp.CodeActionKind.QuickFix.startswith(kind) for kind in kinds):
        found += offer.quick_fixes(context.diagnostics)
    if any(FIX_ALL.startswith(kind) for kind in kinds):
        found += offer.all_fixes()
    return found


class _Offer:
    """Actions that are available in one file."""

    def __init__(self, server: Server, document: Document, state: State, checked: Checked) -> None:
        self._server, self._document = server, document
        self._state, self._package = state, checked.package

    def quick_fixes(self, diagnostics: Sequence[lsp.Diagnostic]) -> Iterator[lsp.CodeAction]:
        """Yield what can be done about diagnostics."""
        known = {each.fingerprint: each for each in self._state.findings}
        for diagnostic in diagnostics:
            data = diagnostic.data if isinstance(diagnostic.data, dict) else {}
            finding = known.get(str(data.get("fingerprint")))
            if finding is not None:
                yield from self._fixes(finding, diagnostic)
                yield from self._suppressions(finding, diagnostic)

    def all_fixes(self) -> Iterator[lsp.CodeAction]:
        """Yield what makes all safe fixes; what other files have a part in is left alone."""
        judge = self._server.session.judge(self._state)
        path = path_in(self._package, self._document.path)

        def findings_here(edited: Package) -> tuple[ReportedFinding, ...]:
            found = ((each, each.fix.edits if each.fix else ()) for each in judge(edited))
            return tuple(each for each, edits in found if {e.place.file for e in edits} == {path})

        for file in fix_package(self._package, findings_here, [Safety.SAFE]).files:
            changes = self._changes()
            changes.add_file(self._document.path, file)
            title = "Fix all in this file (safe fixes)"
            yield lsp.CodeAction(title, kind=FIX_ALL, edit=changes.edit)

    def _changes(self) -> Changes:
        return Changes(self._server.session.documents.values(), self._server.columns)

    def _fixes(
        self, finding: ReportedFinding, diagnostic: lsp.Diagnostic
    ) -> Iterator[lsp.CodeAction]:
        """Yield what fixes a finding here, and what fixes it in all of its places."""
        here = _fix_here(finding, diagnostic)
        for fix in dict.fromkeys(filter(None, (here, finding.fix))):
            changes = self._changes()
            if all(changes.add_edit(self._package, edit) for edit in fix.edits):
                is_safe = fix.safety is Safety.SAFE
                yield _quick_fix(
                    _title(finding, fix.edits) + ("" if is_safe else " (changes behaviour)"),
                    diagnostic,
                    changes.edit,
                    is_preferred=is_safe and fix is (here or finding.fix),
                )

    def _suppressions(
        self, finding: ReportedFinding, diagnostic: lsp.Diagnostic
    ) -> Iterator[lsp.CodeAction]:
        source, line = self._document.source, diagnostic.range.start.line + 1
        if (comment := reason_comment(source, finding.rule, line)) is not None:
            changes = self._changes()
            changes.replace(self._document.path, source, comment.at, comment.at, comment.text)
            title = f"{finding.rule}: suppress here (write the reason)"
            yield _quick_fix(title, diagnostic, changes.edit)
        session, columns = self._server.session, self._server.columns
        edit = rule_switched_off(self._state, finding.rule, session.documents, columns)
        if edit is not None:
            yield _quick_fix(f"{finding.rule}: switch off in the settings", diagnostic, edit)


def _quick_fix(
    title: str,
    diagnostic: lsp.Diagnostic,
    edit: lsp.WorkspaceEdit,
    *,
    is_preferred: bool | None = None,
) -> lsp.CodeAction:
    kind = lsp.CodeActionKind.QuickFix
    return lsp.CodeAction(title, kind, [diagnostic], is_preferred=is_preferred, edit=edit)


def _fix_here(finding: ReportedFinding, diagnostic: lsp.Diagnostic) -> Fix | None:
    """Return the fix of the one place that a diagnostic shows."""
    first, last = diagnostic.range.start.line + 1, diagnostic.range.end.line + 1
    file = next((place.file for place in finding.places if place.line == first), "")
    for fix in finding.fixes:
        if any(e.place.file == file and first <= e.place.line <= last for e in fix.edits):
            return fix
    return None


def _title(finding: ReportedFinding, edits: Sequence[Edit]) -> str:
    """Return what a fix does, if it is one short edit; else which fault it corrects."""
    if len(edits) == 1 and "\n" not in edits[0].original + edits[0].replacement:
        old, new = (shortened(text, _SHOWN) for text in (edits[0].original, edits[0].replacement))
        if old and new:
            return f"{finding.rule}: replace '{old}' with '{new}'"
        return f"{finding.rule}: insert '{new}'" if new else f"{finding.rule}: remove '{old}'"
    places = f" in {len(edits)} places" if len(edits) > 1 else ""
    return f"{finding.rule}: fix {finding.name}{places}"
