"""The exit code of a command that checks."""

from __future__ import annotations

from checker.base.output import EXIT_CLEAN, EXIT_CRASH, EXIT_FINDINGS, EXIT_USAGE
from checker.report.report import Report


def exit_code(report: Report) -> int:
    """Return what went wrong most: unreadable input, then a crash, then findings."""
    if any(item.failed for item in report.not_opened):
        return EXIT_USAGE
    if any(package.crashed for package in report.packages):
        return EXIT_CRASH
    return EXIT_FINDINGS if any(package.failed for package in report.packages) else EXIT_CLEAN
