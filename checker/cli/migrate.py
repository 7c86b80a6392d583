"""`subt-check migrate`: makes the package, checks it, and says what is left to do."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from checker.base.progress import Say, say_nothing
from checker.base.words import plain, shortened
from checker.migrate.migration import Migrated, migrate
from checker.migrate.options import Wishes
from checker.pipeline import check_paths
from checker.report.palette import Palette
from checker.report.report import PackageReport, Report
from checker.report.text_report import to_text

_LINE_LIMIT = 400
"""Characters of a note."""


def migrated_and_checked(
    source: Path,
    destination: Path,
    wishes: Wishes,
    check_wishes: dict[str, Any],
    say: Say = say_nothing,
) -> tuple[str, Report]:
    """Migrate, and check what came out.

    Args:
        source: The description.
        destination: Folder that the package goes into.
        wishes: What the author asks of the migration.
        check_wishes: Fields of `Settings` that the command line sets; None leaves them.
        say: Told what takes long when it begins.

    Returns:
        What to tell the author, and the report on the new package.

    Raises:
        NotMigrated: It cannot be done; no package was made.
        UnreadableInput: The source cannot be opened.
    """
    made = migrate(source, destination, wishes)
    report = check_paths([made.folder], check_wishes, say=say)
    (package,) = report.packages
    verdict = to_text(report, Palette(enabled=False)).splitlines()[-1]
    return "\n".join([*_lines(made, package), verdict, ""]), report


def _lines(made: Migrated, package: PackageReport) -> Iterator[str]:
    yield f"made {plain(str(made.folder))}"
    yield from _listed("decided", made.notes)
    yield from _listed("left to you", made.open_points)
    found = []
    for finding in package.findings:
        place = finding.places[0]
        more = f" (and {len(finding.places) - 1} more)" if len(finding.places) > 1 else ""
        found.append(f"{finding.severity} {finding.rule} {place}: {finding.message}{more}")
    yield from _listed(f"found by subt-check {plain(str(made.folder))}", found)


def _listed(title: str, lines: tuple[str, ...] | list[str]) -> Iterator[str]:
    if lines:
        yield f"{title}:"
        yield from (f"  - {plain(shortened(line, _LINE_LIMIT))}" for line in lines)
