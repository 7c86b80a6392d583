"""The report of a check on a service, told as `check` tells its own."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from msgspec.structs import replace

from checker.base.errors import CheckerError
from checker.base.output import empty_of, show, write
from checker.finding import Severity
from checker.report.files import INDEX, PAGE, STALE
from checker.report.formats import FORMATS
from checker.report.from_json import NoReport, report_from_json
from checker.report.palette import palette_for
from checker.report.render_settings import Manner
from checker.report.report import Report
from checker.service.client.checks import Check, Standing
from checker.service.client.explaining import explained
from checker.service.client.paths import seen_from_here

_AS_THERE = {"json": ("report.json",), "sarif": ("report.sarif",), "html": (PAGE, INDEX)}
"""Formats that are taken as the service wrote them, with the first of these files."""


def tell(check: Check, standing: Standing, options: argparse.Namespace, folder: Path) -> Report:
    """Print the report of a check that is done, write what is wanted of it, and return it.

    Args:
        check: Whose result it is.
        standing: Its last one.
        options: Of the command line.
        folder: Where the command was run.

    Raises:
        CheckerError: The service does not give it, or something cannot be written.
    """
    if options.report:
        _write_all(check, standing, Path(options.report))
    report = seen_from_here(_read(check), Path(options.package))
    if options.fail_on:
        severity = Severity(options.fail_on)
        packages = (replace(each, fail_on=severity) for each in report.packages)
        report = replace(report, packages=tuple(packages))
    if options.format in _AS_THERE:
        content = _file(check, *_AS_THERE[options.format]).decode("utf-8", "replace")
    else:
        palette = palette_for(options.color, None if options.output else sys.stdout)
        content = FORMATS[options.format](explained(report), Manner(palette, str(folder)))
    if options.output:
        write(Path(options.output), content.encode("utf-8", "replace"))
    else:
        show(content)
    return report


def _read(check: Check) -> Report:
    try:
        return report_from_json(_file(check, "report.json").decode("utf-8", "replace"))
    except NoReport as problem:
        raise CheckerError(f"{check.connection.server}: {problem}") from None


def _file(check: Check, *names: str) -> bytes:
    """Return the first file that the result has.

    Raises:
        CheckerError: It has none of them.
    """
    for name in names:
        content = check.file(name)
        if content is not None:
            return content
    raise CheckerError(f"{check.connection.server} has no {names[0]} of the check any more")


def _write_all(check: Check, standing: Standing, folder: Path) -> None:
    """Write the files of the result as `check --report` does."""
    empty_of(folder, STALE)
    for name in check.names(standing):
        content = check.file(name)
        if content is not None:
            write(folder / name, content)
