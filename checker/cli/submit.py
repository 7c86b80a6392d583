"""`subt-check submit`: has a service check a package."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from msgspec.structs import replace

from checker.base.errors import CheckerError
from checker.base.extras import SERVICE
from checker.base.output import (
    EXIT_CRASH,
    Say,
    current_folder,
    empty_of,
    say_nothing,
    say_progress,
    show,
    write,
)
from checker.cli.arguments import add_exit_codes, add_report_options
from checker.cli.exit_code import exit_code
from checker.finding import Severity
from checker.package.formats import single_file_suffixes
from checker.report.files import INDEX, PAGE, STALE
from checker.report.formats import FORMATS
from checker.report.json_report import NoReport, report_from_json
from checker.report.render_settings import RenderSettings, palette_for
from checker.report.report import Report, ReportedFinding
from checker.rulebook.discovery import all_rules
from checker.rulebook.pages import Page, parse_page
from checker.service.client.checks import Check, End, Standing, order
from checker.service.client.connection import Connection, Patience
from checker.service.client.server import Server, parse_server
from checker.service.client.upload import Upload, file_to_send

# What `submit` does and says.


# The report of a check on a service, printed as `check` prints its own.


_AS_THERE = {"json": ("report.json",), "sarif": ("report.sarif",), "html": (PAGE, INDEX)}
"""Formats that are taken as the service wrote them, with the first of these files."""


def print_result(
    check: Check, standing: Standing, options: argparse.Namespace, folder: Path
) -> Report:
    """Print the report of a check that is done, write what is wanted of it, and return it.

    Args:
        check: The check of the result.
        standing: Its last one.
        options: The options of the command line.
        folder: The folder in which the command was run.

    Raises:
        CheckerError: The service does not give it, or something cannot be written.
    """
    if options.report:
        _write_all(check, standing, Path(options.report))
    report = _seen_from_here(_report(check), Path(options.package))
    if options.fail_on:
        severity = Severity(options.fail_on)
        packages = (replace(package, fail_on=severity) for package in report.packages)
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


def _report(check: Check) -> Report:
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


def _seen_from_here(report: Report, path: Path) -> Report:
    """Return a report whose paths start at what was given, not at what the service calls it."""
    packages = (
        replace(package, path=_package_path(package.path, package.name, path))
        for package in report.packages
    )
    not_opened = (
        replace(item, path=str(path / _path_in_upload(item.path))) for item in report.not_opened
    )
    return replace(report, packages=tuple(packages), not_opened=tuple(not_opened))


def _package_path(path: str, name: str, source: Path) -> str:
    if source.name.lower().endswith(single_file_suffixes()):
        return str(source.parent)
    is_itself = source.is_dir() and name == source.resolve().name
    return str(source if is_itself else source / _path_in_upload(path))


def _path_in_upload(path: str) -> str:
    """Return a path without its first part, the name of the upload."""
    return path.partition("/")[2]


def _with_pages(report: Report) -> Report:
    """Return a report with why and how at each finding whose rule is known here too."""
    pages = {rule.id: parse_page(rule.page) for rule in all_rules()}
    packages = [
        replace(package, findings=tuple(_explained(finding, pages) for finding in package.findings))
        for package in report.packages
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


def submit(options: argparse.Namespace, patience: Patience | None = None) -> Report | None:
    """Check a package on a service, and print the report as `check` does.

    Args:
        options: The options of the command line.
        patience: The time limits for the service; the usual ones when None.

    Returns:
        The report; None if the service could not finish, which is stated.

    Raises:
        CheckerError: The package or the upload is refused, or the service cannot be used.
    """
    folder = current_folder()
    if options.report:
        empty_of(Path(options.report))
    server, token = parse_server(options.server), _token(options)
    say = _say if sys.stderr.isatty() else say_nothing
    if token and server.scheme == "http" and not server.is_here:
        _say(f"the token is sent to {server} without encryption; use https://")
    connection = Connection(server, token, patience or Patience(), say)
    with file_to_send(Path(options.package), _say) as file:
        say(f"uploading {file.name}, {file.stat().st_size / 1e6:.1f} MB")
        check = order(connection, Upload(file, options.profile or "", say))
    _say(f"the check is at {check.link}")
    try:
        standing = _waited(check, say)
        if standing.end is End.DONE:
            return print_result(check, standing, options, folder)
    except CheckerError as problem:
        _say(str(problem))
        return None
    return _without_report(standing, server)


def _say(words: str) -> None:
    say_progress(f"subt-check: {words}")


def _token(options: argparse.Namespace) -> str:
    token: str = options.token or os.environ.get("SUBT_CHECK_TOKEN", "")
    if not (token.isascii() and token.isprintable() and " " not in token):
        raise CheckerError(
            "the token contains characters that are not ASCII letters, digits or signs"
        )
    return token


def _waited(check: Check, say: Say) -> Standing:
    """Wait for the end; an interrupt asks whether to cancel the check too."""
    try:
        return check.wait(say)
    except KeyboardInterrupt:
        _offer_to_cancel(check)
        raise


def _offer_to_cancel(check: Check) -> None:
    if sys.stdin.isatty() and sys.stderr.isatty():
        sys.stderr.write("\nsubt-check: cancel the check on the service as well? [y/N] ")
        sys.stderr.flush()
        with suppress(EOFError, KeyboardInterrupt):
            if sys.stdin.readline().strip().lower() in ("y", "yes"):
                check.cancel()
                _say("the check is cancelled")
                return
    _say(f"the check continues at {check.link}")


def _without_report(standing: Standing, server: Server) -> Report | None:
    """Return the reason why there is no report.

    Raises:
        CheckerError: The package is at fault.
    """
    if standing.end is End.REFUSED:
        raise CheckerError(f"{server}: {standing}")
    _say("the check was cancelled" if standing.end is End.CANCELLED else f"{server}: {standing}")
    return None


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    add_exit_codes(parser)
    parser.add_argument(
        "package", metavar="PACKAGE", help="a package folder, an archive or a model file"
    )
    parser.add_argument(
        "--server",
        metavar="URL",
        required=True,
        help="address of the service, such as https://check.example",
    )
    parser.add_argument(
        "--token",
        default="",
        help="access token (safer: the variable SUBT_CHECK_TOKEN, which other users cannot see)",
    )
    add_report_options(parser)


def run(options: argparse.Namespace) -> int:
    """Check a package on a service, and print the report."""
    SERVICE.require_for("submit")
    report = submit(options)
    return EXIT_CRASH if report is None else exit_code(report)
