"""`subt-check migrate`: makes the package, checks it, and prints the remaining work."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from checker.base.extras import PHYSICS
from checker.base.output import Say, say_nothing, say_progress, show
from checker.base.words import count, plain, shortened
from checker.cli.arguments import above_zero, add_exit_codes, argument, ids
from checker.cli.exit_code import exit_code
from checker.migrate.migration import Migrated, migrate
from checker.migrate.options import MigrationOptions
from checker.pipeline import check_paths
from checker.report.render_settings import Palette
from checker.report.report import PackageReport, Report
from checker.report.text_report import verdict_text

_LINE_LIMIT = 400
"""Characters of a note."""


def migrate_and_check(
    source: Path,
    destination: Path,
    wishes: MigrationOptions,
    check_wishes: dict[str, Any],
    say: Say = say_nothing,
) -> tuple[str, Report]:
    """Migrate, and check the result.

    Args:
        source: The description.
        destination: Folder of the package.
        wishes: Options of the migration.
        check_wishes: Fields of `Settings` that the command line sets; None leaves them.
        say: Called with a message when a long step starts.

    Returns:
        The message for the author, and the report on the new package.

    Raises:
        NotMigrated: It cannot be done; no package was made.
        UnreadableInput: The source cannot be opened.
    """
    migrated = migrate(source, destination, wishes)
    report = check_paths([migrated.folder], check_wishes, say=say)
    (package,) = report.packages
    verdict = verdict_text(package, Palette(enabled=False))
    return "\n".join([*_lines(migrated, package), verdict, ""]), report


def _lines(migrated: Migrated, package: PackageReport) -> Iterator[str]:
    yield f"made {plain(str(migrated.folder))}"
    yield from _listed("decided", migrated.notes)
    yield from _listed("left to you", migrated.open_points)
    lines = []
    for finding in package.findings:
        place = finding.places[0]
        more = f" (and {len(finding.places) - 1} more)" if len(finding.places) > 1 else ""
        lines.append(f"{finding.severity} {finding.rule} {place}: {finding.message}{more}")
    yield from _listed(f"found by subt-check {plain(str(migrated.folder))}", lines)
    yield from _listed(f"to fill in ({count(len(migrated.to_do), 'TODO')})", migrated.to_do)


def _listed(title: str, lines: tuple[str, ...] | list[str]) -> Iterator[str]:
    if lines:
        yield f"{title}:"
        yield from (f"  - {plain(shortened(line, _LINE_LIMIT))}" for line in lines)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    add_exit_codes(parser)
    parser.add_argument("source", metavar="SOURCE", help="a description package, or a URDF file")
    parser.add_argument("destination", metavar="DEST", help="a workspace, or a new folder")
    parser.add_argument(
        "--organization",
        metavar="NAME",
        default="",
        help="name of the organization that submits the robot",
    )
    parser.add_argument(
        "--robot", metavar="NAME", default="", help="name of the robot (default: the URDF's name)"
    )
    parser.add_argument(
        "--config", type=int, default=1, metavar="N", help="configuration number (default: 1)"
    )
    for side in ("left", "right"):
        parser.add_argument(
            f"--{side}-wheels",
            metavar="JOINTS",
            type=ids,
            default=(),
            help=f"drive joints on the {side}, separated by commas (default: guessed)",
        )
    for limit, unit in (("velocity", "m/s"), ("acceleration", "m/s²")):
        parser.add_argument(
            f"--max-{limit}",
            metavar="NUMBER",
            type=above_zero,
            help=f"limit of the drive, {unit} (default: the limits of the joints and SubT)",
        )
    parser.add_argument("--urdf", metavar="FILE", default="", help="file that contains the robot")
    parser.add_argument(
        "--args",
        metavar="NAME:=VALUE",
        nargs="+",
        type=argument,
        default=[],
        help="argument for xacro",
    )
    parser.add_argument("--no-trial", action="store_true", help="skip the trial")
    parser.add_argument("--no-cache", action="store_true", help="do not use the cache")


def run(options: argparse.Namespace) -> int:
    """Make a package of a description, check it, and state what is left to do."""
    PHYSICS.require_for("migrate")
    wishes = MigrationOptions(
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
    text, report = migrate_and_check(source, destination, wishes, settings, say)
    show(text)
    return exit_code(report)
