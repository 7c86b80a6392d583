"""What `submit` does and says."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from checker.base.errors import CheckerError, UnreadableInput
from checker.base.output import empty_of, here, say_progress
from checker.base.progress import Say, say_nothing
from checker.package.archives.archive import ARCHIVE_SUFFIXES
from checker.package.inputs import SINGLE_FILE_SUFFIXES
from checker.package.kind import enclosing_package
from checker.report.report import Report
from checker.service.client.checks import Check, End, Standing, order
from checker.service.client.connection import Connection, Patience
from checker.service.client.form import Form
from checker.service.client.packing import pack
from checker.service.client.server import Server, parse_server
from checker.service.client.telling import tell

_TENTHS = 10


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
    with _file_of(Path(options.package)) as file:
        fields = {"profile": options.profile} if options.profile else {}
        check = order(connection, Form(file, file.name, fields, _told(file, say)))
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
        raise CheckerError("the token holds other than ASCII letters, digits and signs")
    return token


@contextmanager
def _file_of(path: Path) -> Iterator[Path]:
    """Give the file to send: an archive or a model file as it is, a folder packed.

    Raises:
        UnreadableInput: It is none of them, or cannot be read.
    """
    if not _is_folder(path):
        _refuse_file(path)
        around = enclosing_package(path.resolve().parent)
        if around and path.name.lower().endswith(SINGLE_FILE_SUFFIXES):
            _say(f"{path} is sent alone; for its meshes, give the folder {around}")
        yield path
        return
    with tempfile.TemporaryDirectory(prefix="subt-check-", ignore_cleanup_errors=True) as own:
        packed = Path(own) / f"{path.resolve().name or 'package'}.zip"
        with packed.open("wb") as archive:
            left_out = pack(path, archive)
        for words in left_out:
            _say(f"{path}: {words}")
        yield packed


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except OSError:  # such as a name that is too long: said when it is opened
        return False


def _refuse_file(path: Path) -> None:
    advice = "give a package folder, a .zip or .tar.gz archive, or a model file"
    try:
        if not path.exists():
            raise UnreadableInput(path, "does not exist", "check the spelling")
        known = path.name.lower().endswith((*ARCHIVE_SUFFIXES, *SINGLE_FILE_SUFFIXES))
        if not known or not path.is_file():
            raise UnreadableInput(path, "is no package, archive or model file", advice)
        with path.open("rb"):
            pass
    except (OSError, ValueError) as error:
        reason = f"cannot be opened: {getattr(error, 'strerror', None) or error}"
        raise UnreadableInput(path, reason, "check its permissions") from None


def _told(file: Path, say: Say) -> Callable[[int], None]:
    """Return what says how much of a file is sent, each tenth once."""
    size, said = max(file.stat().st_size, 1), 0
    say(f"uploading {file.name}, {size / 1e6:.1f} MB")

    def told(sent: int) -> None:
        nonlocal said
        tenths = _TENTHS * sent // size
        if tenths != said and size > 1_000_000:
            said = tenths
            say(f"uploaded {100 * tenths // _TENTHS} %")

    return told


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
    _say(f"the check goes on at {check.link}")


def _without_report(standing: Standing, server: Server) -> Report | None:
    """Say why there is no report.

    Raises:
        CheckerError: The package is at fault.
    """
    if standing.end is End.REFUSED:
        raise CheckerError(f"{server}: {standing}")
    _say("the check was cancelled" if standing.end is End.CANCELLED else f"{server}: {standing}")
    return None
