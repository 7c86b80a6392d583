"""`subt-check check`: checks packages and tells the report."""

from __future__ import annotations

import argparse
import shlex
import sys
from contextlib import suppress
from pathlib import Path

from checker.base.errors import CheckerError, InvalidSettings, UnreadableInput
from checker.base.garbage_collection import collection_put_off
from checker.base.output import (
    EXIT_CLEAN,
    EXIT_FINDINGS,
    empty_of,
    here,
    say_nothing,
    say_progress,
    show,
    write,
)
from checker.base.words import plain, shortened
from checker.cli.arguments import (
    DISTROS,
    FORMAT_NAMES,
    PROFILES,
    add_exit_codes,
    ids,
    positive,
    xacro_argument,
)
from checker.cli.baseline import baseline_to_renew, write_baseline
from checker.cli.exit_code import exit_code
from checker.finding import Safety, Severity
from checker.pipeline import check_paths, settings_of
from checker.report.files import STALE, artefacts
from checker.report.formats import FORMATS
from checker.report.render_settings import RenderSettings, palette_for
from checker.report.report import Report
from checker.report.summary import statistics_text
from checker.rulebook.discovery import all_rules
from checker.rulebook.suppression.baseline import DEFAULT_FILE, Baseline, read_baseline


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    add_exit_codes(parser)
    parser.add_argument(
        "paths",
        nargs="+",
        metavar="PATH",
        help="a package folder, an archive (.zip, .tar.gz), a folder of packages, or a model file",
    )
    parser.add_argument(
        "--files",
        action="store_true",
        help="each PATH is a changed file: check the packages of these files",
    )
    parser.add_argument("--format", choices=FORMAT_NAMES, default="text")
    parser.add_argument(
        "--output", metavar="FILE", help="write the result to this file instead of stdout"
    )
    parser.add_argument(
        "--report",
        metavar="DIR",
        help="also write report.html, report.json, report.sarif and robot.glb into this folder",
    )
    parser.add_argument(
        "--statistics", action="store_true", help="print the number of findings of each rule"
    )
    parser.add_argument(
        "--profile", choices=PROFILES, help="set of rules (default: what suits the package)"
    )
    parser.add_argument(
        "--distro", choices=DISTROS, help="ROS 2 distribution to judge for (default: jazzy)"
    )
    parser.add_argument(
        "--select", metavar="IDS", type=ids, help="run only these rules, groups, or concern:robot"
    )
    parser.add_argument("--ignore", metavar="IDS", type=ids, help="do not run these")
    parser.add_argument(
        "--package-path",
        metavar="DIR",
        action="append",
        type=Path,
        help="also find packages in this folder, or this package; may be repeated",
    )
    parser.add_argument(
        "--xacro-arg",
        metavar="NAME:=VALUE",
        action="append",
        type=xacro_argument,
        help="give xacro files this argument; may be repeated",
    )
    parser.add_argument(
        "--fail-on",
        choices=("error", "warning"),
        help="lowest severity that fails (default: error)",
    )
    parser.add_argument("--fix", action="store_true", help="apply safe fixes, then check")
    parser.add_argument(
        "--unsafe",
        action="store_true",
        help="with --fix or --diff: also fixes that change behaviour",
    )
    parser.add_argument(
        "--diff", action="store_true", help="print the fixes as a patch and do nothing else"
    )
    parser.add_argument("--baseline", metavar="FILE", help="ignore findings that are in this file")
    parser.add_argument(
        "--write-baseline",
        action="store_true",
        help=(
            "write the current findings to a baseline file and do nothing else (default: the file "
            "in the settings, else subt-check-baseline.json)"
        ),
    )
    parser.add_argument("--no-trial", action="store_true", help="skip the trial")
    parser.add_argument(
        "--thorough", action="store_true", help="repeat the trial at half the time step"
    )
    parser.add_argument("--no-cache", action="store_true", help="do not use the cache")
    parser.add_argument("--jobs", type=positive, default=1, metavar="N", help="number of processes")
    parser.add_argument("--color", choices=("auto", "always", "never"), default="auto")


@collection_put_off()
def run(options: argparse.Namespace) -> int:
    """Check packages and print the report."""
    _refuse_together(options)
    folder = here()
    # What cannot be written is said before all is checked.
    renewed = _to_renew(options) if options.write_baseline else None
    if options.report:
        empty_of(Path(options.report))
    wishes = {
        "profile": options.profile,
        "distro": options.distro,
        "select": options.select,
        "ignore": options.ignore,
        "package_path": tuple(options.package_path) if options.package_path else None,
        "xacro_args": dict(options.xacro_arg) if options.xacro_arg else None,
        "fail_on": Severity(options.fail_on) if options.fail_on else None,
        "trial": False if options.no_trial else None,
        "thorough": True if options.thorough else None,
        "cache": False if options.no_cache else None,
        "baseline": Baseline() if renewed else _baseline(options),
        "display": True if options.report or options.format == "html" else None,
    }
    paths = [Path(path) for path in options.paths]
    if options.files:
        from checker.package.kind import changed_packages

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
    for item in report.not_opened:
        if item.failed:
            print(
                f"subt-check: {plain(shortened(item.path, 300))} {plain(item.reason)}",
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
                raise CheckerError(
                    f"{one} and {two} cannot be used together; leave out one of them"
                )
    if options.write_baseline and options.format != "text":
        raise CheckerError("--write-baseline only writes the baseline; leave out --format")


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
            named |= {settings.baseline.path for settings in settings_of(path)}
    only = named.pop() if len(named) == 1 else None
    return baseline_to_renew(_from(here(), only) if only else Path(DEFAULT_FILE))


def _from(folder: Path, path: Path) -> Path:
    return path.relative_to(folder) if path.is_relative_to(folder) else path


def _tell(report: Report, options: argparse.Namespace) -> None:
    """Write the report in all the ways that are asked for."""
    stream = None if options.output else sys.stdout
    command = shlex.join(("subt-check", *options.words))
    manner = RenderSettings(palette_for(options.color, stream), str(here()), command)
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
