"""What `submit` does and says."""

from __future__ import annotations

import argparse
import os
import sys
from contextlib import suppress
from pathlib import Path

from checker.base.errors import CheckerError
from checker.base.output import empty_of, here, say_progress
from checker.base.progress import Say, say_nothing
from checker.report.report import Report
from checker.service.client.checks import Check, End, Standing, order
from checker.service.client.connection import Connection, Patience
from checker.service.client.result import tell
from checker.service.client.server import Server, parse_server
from checker.service.client.upload import Upload, file_to_send


def submit(options: argparse.Namespace, patience: Patience | None = None) -> Report | None:
    """Have a service check a package, and print the report as `check` does.

    Args:
        options: Of the command line.
        patience: With the service; the usual one when None.

    Returns:
        The report; None if the service could not finish, which is said.

    Raises:
        CheckerError: The package or the upload is refused, or the service cannot be used.
    """
    folder = here()
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
            return tell(check, standing, options, folder)
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
    """Wait for the end; who interrupts is asked whether the check shall end as well."""
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
    """Say why there is no report.

    Raises:
        CheckerError: The package is at fault.
    """
    if standing.end is End.REFUSED:
        raise CheckerError(f"{server}: {standing}")
    _say("the check was cancelled" if standing.end is End.CANCELLED else f"{server}: {standing}")
    return None
