"""The report of a check on a service, told as `check` tells its own."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path

from msgspec.structs import replace

from checker.base.errors import CheckerError
from checker.base.output import empty_of, show, write
from checker.finding import Severity
from checker.package.inputs import SINGLE_FILE_SUFFIXES
from checker.report.files import INDEX, PAGE, STALE
from checker.report.formats import FORMATS
from checker.report.json_report import NoReport, report_from_json
from checker.report.palette import palette_for
from checker.report.render_settings import RenderSettings
from checker.report.report import Report, ReportedFinding
from checker.rulebook.discovery import all_rules
from checker.rulebook.pages import Page, parse_page
from checker.service.client.checks import Check, Standing

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
    report = _seen_from_here(_read(check), Path(options.package))
    if options.fail_on:
        severity = Severity(options.fail_on)
        packages = (replace(each, fail_on=severity) for each in report.packages)
        report = replace(report, packages=tuple(packages))
    if options.format in _AS_THERE:
        content = _file(check, *_AS_THERE[options.format]).decode("utf-8", "replace")
    else:
        palette = palette_for(options.color, None if options.output else sys.stdout)
        content = FORMATS[options.format](_with_pages(report), RenderSettings(palette, str(folder)))
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
    raise CheckerError(f"{check.connection.server} no longer has the {names[0]} of the check")


def _write_all(check: Check, standing: Standing, folder: Path) -> None:
    """Write the files of the result as `check --report` does."""
    empty_of(folder, STALE)
    for name in check.names(standing):
        content = check.file(name)
        if content is not None:
            write(folder / name, content)


def _seen_from_here(report: Report, given: Path) -> Report:
    """Return a report whose paths start at what was given, not at what the service calls it."""
    packages = (
        replace(each, path=_package_path(each.path, each.name, given)) for each in report.packages
    )
    not_opened = (replace(each, path=str(given / _below(each.path))) for each in report.not_opened)
    return replace(report, packages=tuple(packages), not_opened=tuple(not_opened))


def _package_path(path: str, name: str, given: Path) -> str:
    if given.name.lower().endswith(SINGLE_FILE_SUFFIXES):
        return str(given.parent)
    is_itself = given.is_dir() and name == given.resolve().name
    return str(given if is_itself else given / _below(path))


def _below(path: str) -> str:
    """Return a path without its first part, the name of the upload."""
    return path.partition("/")[2]


def _with_pages(report: Report) -> Report:
    """Return a report with why and how at each finding whose rule is known here as well."""
    pages = {rule.id: parse_page(rule.page) for rule in all_rules()}
    packages = [
        replace(each, findings=tuple(_explained(found, pages) for found in each.findings))
        for each in report.packages
    ]
    return replace(report, packages=tuple(packages))


def _explained(finding: ReportedFinding, pages: Mapping[str, Page]) -> ReportedFinding:
    page = pages.get(finding.rule)
    if page is None:
        return finding
    return replace(
        finding,
        why=page.reason,
        how=" ".join(page.fix.split()),
        title=page.title,
        source=" ".join(page.source.split()),
    )
