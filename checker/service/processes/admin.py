"""Command `admin`."""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Sequence

from msgspec import to_builtins

from checker.base.errors import CheckerError, Unreachable
from checker.base.files import UMASK
from checker.base.output import EXIT_CLEAN, show
from checker.service.jobs.durable.admin import Admin, Listed
from checker.service.jobs.durable.database import database_url, open_database, reachable
from checker.service.jobs.durable.prepare import prepare_database
from checker.service.jobs.durable.receipts import SHOWN_DIGITS
from checker.service.jobs.durable.retention import Retention
from checker.service.jobs.durable.workers import Workers
from checker.service.jobs.port import JobsUnreachable, Stage
from checker.service.store.place import DATABASE, choose, data_folder
from checker.service.store.store import open_store

_UNITS = ((86400.0, "d"), (3600.0, "h"), (60.0, "min"))


def admin(options: argparse.Namespace) -> int:
    """Do an action.

    Raises:
        Unreachable: The database does not answer.
        CheckerError: The requested check does not exist.
    """
    os.umask(UMASK)
    choose(options.data, options.store)
    try:
        with reachable():
            show(_done(options, _opened()))
    except JobsUnreachable as error:
        raise Unreachable(str(error)) from None
    return EXIT_CLEAN


def _opened() -> Admin:
    """Return the service whose database is there already.

    Raises:
        CheckerError: There is none.
        JobsUnreachable: It does not answer.
    """
    folder = data_folder()
    if not os.environ.get("SUBT_CHECK_DATABASE_URL") and not (folder / DATABASE).is_file():
        raise CheckerError(
            f"{folder} has no {DATABASE}, expected the data folder of a service; choose it with "
            "--data, or its database with SUBT_CHECK_DATABASE_URL"
        )
    checks = prepare_database(open_database(database_url()))
    return Admin(checks, Workers(checks.engine))


def _done(options: argparse.Namespace, service: Admin) -> str:
    """Run the command and return its message."""
    match options.action:
        case "list":
            listed = [*service.list_checks()]
            return (
                json.dumps(to_builtins(listed), indent=2) + "\n" if options.json else _table(listed)
            )
        case "requeue":
            keys = (
                [each.key for each in service.list_checks() if each.stage is Stage.FAILED]
                if options.failed
                else service.keys_of(options.keys, over=True)
            )
            for key in keys:
                service.requeue(key)
            return "".join(f"requeued {key}\n" for key in keys) or "no check has failed\n"
        case "cancel":
            keys = service.keys_of(options.keys, over=False)
            for key in keys:
                service.checks.cancel(key)
            return "".join(f"cancelled {key}\n" for key in keys)
        case "drain":
            names = service.drain(options.names)
            return "".join(f"drains {name}\n" for name in names) or "no worker is alive\n"
        case _:
            gone = Retention(service.checks, open_store()).delete()
            return f"deleted: {', '.join(f'{kind} {number}' for kind, number in gone.items())}\n"


def _table(listed: Sequence[Listed]) -> str:
    """Return the checks, one a line."""
    rows = [("KEY", "STAGE", "TRY", "AGE", "WORKER", "WORDS")]
    rows += [
        (
            *(each.key[:SHOWN_DIGITS], each.stage.value, str(each.number), _age(each.age)),
            *(each.worker or "-", each.words),
        )
        for each in listed
    ]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)][:-1]
    return "".join(
        "  ".join((*(text.ljust(width) for text, width in zip(row, widths, strict=False)), row[-1]))
        + "\n"
        for row in rows
    )


def _age(seconds: float) -> str:
    for length, unit in _UNITS:
        if seconds >= length:
            return f"{seconds // length:.0f} {unit}"
    return f"{seconds:.0f} s"
