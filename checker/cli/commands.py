"""What the commands of `subt-check` do."""

from __future__ import annotations

import argparse
import json
import shlex
import sys
from contextlib import suppress
from pathlib import Path

from checker.base.errors import CheckerError, InvalidSettings, UnreadableInput
from checker.base.garbage_collection import collection_put_off
from checker.base.output import (
    EXIT_CLEAN,
    EXIT_CRASH,
    EXIT_FINDINGS,
    EXIT_USAGE,
    empty_of,
    here,
    say_progress,
    show,
    write,
)
from checker.base.progress import say_nothing
from checker.base.words import plain, shortened
from checker.cli.baseline import baseline_to_renew, write_baseline
from checker.engine.options import no_such_rule
from checker.finding import Safety, Severity
from checker.pipeline import check_paths, settings_of
from checker.report.files import STALE, artefacts
from checker.report.formats import FORMATS
from checker.report.palette import palette_for
from checker.report.render_settings import Manner
from checker.report.report import Report
from checker.report.summary import statistics_text
from checker.rule import Rule
from checker.rulebook.discovery import all_rules
from checker.rulebook.pages import parse_page
from checker.rulebook.suppression.baseline import DEFAULT_FILE, Baseline, read_baseline


@collection_put_off()
def check(options: argparse.Namespace) -> int:
    """Check packages and print the report."""
    _refuse_together(options)
    folder = here()
    # What cannot be written is said before all is checked.
    renewed = _to_renew(options) if options.write_baseline else None
    if options.report:
        empty_of(Path(options.report))
    wishes = {
        "profile": options.profile,
        "select": options.select,
        "ignore": options.ignore,
        "fail_on": Severity(options.fail_on) if options.fail_on else None,
        "trial": False if options.no_trial else None,
        "thorough": True if options.thorough else None,
        "cache": False if options.no_cache else None,
        "baseline": Baseline() if renewed else _baseline(options),
        "display": True if options.report or options.format == "html" else None,
    }
    paths = [Path(path) for path in options.paths]
    if options.files:
        from checker.package.changed_files import changed_packages

        paths = changed_packages(paths, folder)
        if not paths:
            return EXIT_CLEAN
    if options.diff or options.fix:
        from checker.cli.fix import apply_fixes, show_patch

        allowed = list(Safety) if options.unsafe else [Safety.SAFE]
        if options.diff:
            return show_patch(paths, wishes, allowed, options.output or "")
        apply_fixes(paths, wishes, allowed)
    say = say_progress if sys.stderr.isatty() else say_nothing
    report = check_paths(paths, wishes, options.jobs, say)
    for each in report.not_opened:
        if each.failed:
            print(
                f"subt-check: {plain(shortened(each.path, 300))} {plain(each.reason)}",
                file=sys.stderr,
            )
    if renewed:
        ids = {rule.id for rule in all_rules()}
        show(write_baseline(renewed, report, ids))
        return EXIT_CLEAN if exit_code(report) == EXIT_FINDINGS else exit_code(report)
    _tell(report, options)
    return exit_code(report)


_APART = {
    # A hook writes nothing, whatever files of a commit are named.
    "files": ("fix", "output", "report", "write_baseline"),
    # It writes one file.
    "write_baseline": ("fix", "diff", "output", "report", "statistics"),
}
"""Options, and those that do not go with them."""


def _refuse_together(options: argparse.Namespace) -> None:
    """Refuse options that contradict each other.

    Raises:
        CheckerError: There are such options.
    """
    for option, others in _APART.items():
        for other in others if getattr(options, option) else ():
            if getattr(options, other):
                one, two = (f"--{name.replace('_', '-')}" for name in (option, other))
                raise CheckerError(f"{one} and {two} do not go together; leave out one of them")
    if options.write_baseline and options.format != "text":
        raise CheckerError("--write-baseline writes the baseline alone; leave out --format")


def _baseline(options: argparse.Namespace) -> Baseline | None:
    """Return the baseline that the command line wants; None leaves it to the settings."""
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
        with suppress(UnreadableInput):  # said when it is to be checked
            named |= {each.baseline.path for each in settings_of(path)}
    only = named.pop() if len(named) == 1 else None
    return baseline_to_renew(_from(here(), only) if only else Path(DEFAULT_FILE))


def _from(folder: Path, path: Path) -> Path:
    return path.relative_to(folder) if path.is_relative_to(folder) else path


def _tell(report: Report, options: argparse.Namespace) -> None:
    """Write the report in all the ways that are asked for."""
    stream = None if options.output else sys.stdout
    command = shlex.join(("subt-check", *options.words))
    manner = Manner(palette_for(options.color, stream), str(here()), command)
    written = FORMATS[options.format](report, manner)
    if options.output:
        write(Path(options.output), written)
    else:
        show(written)
    if options.report:
        folder = empty_of(Path(options.report), STALE)
        for name, content in artefacts(report, manner):
            write(folder / name, content)
    if options.statistics:
        # Behind another format's report it would spoil it.
        tell = show if options.output or options.format == "text" else say_progress
        tell("\n" + statistics_text(report))


def exit_code(report: Report) -> int:
    """Return what went wrong most: unreadable input, then a crash, then findings."""
    if any(each.failed for each in report.not_opened):
        return EXIT_USAGE
    if any(package.crashed for package in report.packages):
        return EXIT_CRASH
    return EXIT_FINDINGS if any(package.failed for package in report.packages) else EXIT_CLEAN


def explain_rule(wanted: str) -> int:
    """Print a rule's page."""
    from checker.cli.rule_text import page_text

    rules = all_rules()
    rule = next((r for r in rules if wanted.upper() == r.id or wanted.lower() == r.name), None)
    if rule is None:
        known = [name for rule in rules for name in (rule.id, rule.name)]
        raise CheckerError(no_such_rule(wanted, known))
    show(page_text(rule) + "\n")
    return EXIT_CLEAN


def export(options: argparse.Namespace) -> int:
    """Write a package's robot in another format."""
    from checker.cli.export import export

    output = Path(options.output) if options.output else None
    return export(Path(options.path), options.format, output, cached=not options.no_cache)


def migrate(options: argparse.Namespace) -> int:
    """Make a package of a description, check it, and say what is left to do."""
    from checker.cli.migrate import migrated_and_checked
    from checker.migrate.options import Wishes

    wishes = Wishes(
        options.organization,
        options.robot,
        options.config,
        options.left_wheels,
        options.right_wheels,
        options.max_velocity,
        options.max_acceleration,
        options.urdf,
        dict(options.args),
    )
    settings = {
        "trial": False if options.no_trial else None,
        "cache": False if options.no_cache else None,
    }
    say = say_progress if sys.stderr.isatty() else say_nothing
    source, destination = Path(options.source), Path(options.destination)
    said, report = migrated_and_checked(source, destination, wishes, settings, say)
    show(said)
    return exit_code(report)


def submit(options: argparse.Namespace) -> int:
    """Have a service check a package, and print the report."""
    from checker.service.client.command import submit

    report = submit(options)
    return EXIT_CRASH if report is None else exit_code(report)


def init(options: argparse.Namespace) -> int:
    """Write what a repository needs to be checked."""
    from checker.cli.init import init

    show(init(Path(options.path)))
    return EXIT_CLEAN


def list_rules(form: str) -> int:
    """List all rules, by group."""
    if form == "json":
        listed = [_as_dict(rule) for rule in all_rules()]
        show(json.dumps(listed, indent=2) + "\n")
        return EXIT_CLEAN
    for rule in all_rules():
        title = parse_page(rule.page).title
        show(f"{rule.id}  {rule.severity:<7}  {rule.name:<32}  {title}\n")
    return EXIT_CLEAN


def _as_dict(rule: Rule) -> dict[str, object]:
    from checker.rulebook.options import words_of

    page = parse_page(rule.page)
    return {
        "id": rule.id,
        "name": rule.name,
        "severity": str(rule.severity),
        "title": page.title,
        "why": page.why,
        "fix": page.fix,
        "source": page.source,
        "options": rule.options,
        "option_words": words_of(rule),
    }
