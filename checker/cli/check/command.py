"""`subt-check check`: checks packages and prints the report."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from checker.base.errors import InvalidSettings, UnreadableInput
from checker.base.garbage_collection import collection_put_off
from checker.base.output import EXIT_CLEAN, EXIT_FINDINGS, current_folder, empty_of, show
from checker.cli.arguments import search_wishes
from checker.cli.check.arguments import add_arguments, refuse_contradictions
from checker.cli.check.baseline import baseline_to_renew, write_baseline
from checker.cli.check.results import check_and_print, write_results
from checker.cli.exit_code import exit_code
from checker.finding import Safety, Severity
from checker.pipeline import settings_of
from checker.rulebook.discovery import all_rules
from checker.rulebook.suppression.baseline import DEFAULT_FILE, Baseline, read_baseline

__all__ = ["add_arguments", "run"]


@collection_put_off()
def run(options: argparse.Namespace) -> int:
    """Check packages and print the report."""
    refuse_contradictions(options)
    folder = current_folder()
    # What cannot be written is said before all is checked.
    renewed = _to_renew(options) if options.write_baseline else None
    if options.report:
        empty_of(Path(options.report))
    wishes = _wishes(options, renewed)
    paths = [Path(path) for path in options.paths]
    if options.files:
        from checker.package.kind import changed_packages

        paths = changed_packages(paths, folder)
        if not paths:
            return EXIT_CLEAN
    if options.diff or options.fix:
        from checker.cli.check.fix import apply_fixes, show_patch

        allowed = list(Safety) if options.unsafe else [Safety.SAFE]
        if options.diff:
            output = options.output or ""
            return show_patch(paths, wishes, allowed, output, prove=options.prove)
        apply_fixes(paths, wishes, allowed, dirty=options.allow_dirty, prove=options.prove)
    report = check_and_print(paths, wishes, options)
    if renewed:
        ids = {rule.id for rule in all_rules()}
        show(write_baseline(renewed, report, ids))
        return EXIT_CLEAN if exit_code(report) == EXIT_FINDINGS else exit_code(report)
    write_results(report, options)
    return exit_code(report)


def _wishes(options: argparse.Namespace, renewed: Baseline | None) -> Mapping[str, Any]:
    """Return the settings that the command line sets; None leaves one to the settings files."""
    return {
        "profile": options.profile,
        "distro": options.distro,
        "select": options.select,
        "ignore": options.ignore,
        **search_wishes(options),
        "payload": options.payload,
        "fail_on": Severity(options.fail_on) if options.fail_on else None,
        "trial": False if options.no_trial else None,
        "thorough": True if options.thorough else None,
        "cache": False if options.no_cache else None,
        "baseline": Baseline() if renewed else _baseline(options),
        "display": True if options.report or options.format == "html" else None,
    }


def _baseline(options: argparse.Namespace) -> Baseline | None:
    """Return the baseline of the command line; None leaves it to the settings."""
    if not options.baseline:
        return None
    baseline = read_baseline(Path(options.baseline))
    if baseline.fault:
        raise InvalidSettings(baseline.path, baseline.fault)
    return baseline


def _to_renew(options: argparse.Namespace) -> Baseline:
    """Return the baseline to write: the named one, else that of the settings if all agree on it."""
    if options.baseline:
        return baseline_to_renew(Path(options.baseline))
    named: set[Path | None] = set()
    for path in map(Path, options.paths):
        with suppress(UnreadableInput):  # reported when it is checked
            named |= {settings.baseline.path for settings in settings_of(path)}
    only = named.pop() if len(named) == 1 else None
    return baseline_to_renew(_relative(current_folder(), only) if only else Path(DEFAULT_FILE))


def _relative(folder: Path, path: Path) -> Path:
    return path.relative_to(folder) if path.is_relative_to(folder) else path
