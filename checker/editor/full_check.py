"""A check with weights and trial, in a process that the user can stop."""

from __future__ import annotations

import multiprocessing
import os
import sys
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any

from checker.base.cache import NO_CACHE, Cache, cache_folder
from checker.base.parts import WorkerFailed
from checker.base.record import Record
from checker.package.package import Package
from checker.report.report import PackageReport
from checker.settings import Settings


class Order(Record, eq=False):
    """What to check.

    Attributes:
        package: With the texts of the editor.
        settings: The user's.
    """

    package: Package
    settings: Settings


class FullCheck:
    """A check that goes on in a process of its own."""

    def __init__(self, order: Order) -> None:
        """Start it."""
        # Not forked: the server has threads.
        context = multiprocessing.get_context("spawn")
        self._answer, theirs = context.Pipe(duplex=False)
        self._process = context.Process(target=_check, args=(theirs, order), daemon=True)
        self._process.start()
        theirs.close()

    def result(self) -> PackageReport | WorkerFailed:
        """Wait for the report."""
        try:
            report = self._answer.recv()
        except (EOFError, OSError):
            return WorkerFailed("was stopped")
        finally:
            self._process.join()
            self._answer.close()
        return (
            report if isinstance(report, PackageReport | WorkerFailed) else WorkerFailed("failed")
        )

    def stop(self) -> None:
        """End it; `result` then tells that it was stopped."""
        with suppress(OSError, ValueError):
            self._process.terminate()


def _check(answer: Connection, order: Order) -> None:
    """Check, and send the report."""
    # What is printed here would end up among the words of the protocol.
    with suppress(OSError):
        os.dup2(sys.stderr.fileno(), 1)
    answer.send(_report(order))


def _report(order: Order) -> Any:
    from checker.base.errors import CheckerError
    from checker.engine.review import judged

    cache = Cache(cache_folder()) if order.settings.cache else NO_CACHE
    try:
        return judged(order.package, str(order.package.root), order.settings, cache, lambda _: None)
    except CheckerError as error:
        return WorkerFailed(str(error))
