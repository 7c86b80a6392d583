"""The verdict on the package of a file, for the status bar of an editor."""

from __future__ import annotations

from checker.base.words import count
from checker.editor.session import State
from checker.engine.real_paths import neighbours_of, with_real_paths
from checker.engine.review import what_is_unread
from checker.finding import Severity
from checker.report.report import NO_TRIAL, Cause, NotChecked, PackageReport
from checker.report.summary import sentence

VERDICT = "subt-check/verdict"
"""The notification; it is sent to clients that set the option `verdict`."""
Verdict = dict[str, str | int]


def verdict_of(state: State | None) -> Verdict:
    """Return the verdict on a package as the notification has it; see docs/editors.md.

    Args:
        state: What is known of the package; None outside of packages.
    """
    if state is None:
        return {"verdict": "none"}
    report = _report_of(state)
    if report is None:
        why = state.problem.message if state.problem else ""
        return {"verdict": "not_checked", "text": "Not checked", "sentence": why}
    whole = sentence(report)
    errors, warnings = map(report.count, (Severity.ERROR, Severity.WARNING))
    counts = [count(errors, "error")] * bool(errors) or [count(warnings, "warning")] * bool(
        warnings
    )
    return {
        "package": report.name,
        "verdict": report.verdict.value,
        "text": ": ".join([whole.lead, *counts]),
        "sentence": str(whole),
        "errors": errors,
        "warnings": warnings,
    }


def _report_of(state: State) -> PackageReport | None:
    """Return what decides about a package: findings, and what was not checked."""
    checked, measured = state.checked, state.measured
    if checked is None:
        return None
    not_checked = [*checked.outcome.not_checked, *what_is_unread(checked.subject)]
    if measured is None:
        not_checked.append(NotChecked("trial", NO_TRIAL, Cause.SWITCHED_OFF))
    else:
        not_checked += [it for it in measured.report.not_checked if it.rule in measured.rules]
    package = checked.package
    return PackageReport(
        package.name,
        str(package.root),
        str(package.kind),
        tuple(with_real_paths(package, state.findings)),
        tuple(not_checked),
        suppressed=checked.outcome.suppressed,
        neighbours=neighbours_of(package, state.findings),
    )
