"""A check with weights and trial, in a process that the user can stop."""

from __future__ import annotations

import multiprocessing
from contextlib import suppress
from multiprocessing.connection import Connection

from checker.base.cache import NO_CACHE, Cache, cache_folder
from checker.base.errors import CheckerError
from checker.base.output import say_nothing
from checker.base.parts import WorkerFailed
from checker.package.package import Package
from checker.report.report import PackageReport
from checker.settings import Settings


class FullCheck:
    """A check that runs in its own process."""

    def __init__(self, package: Package, settings: Settings) -> None:
        """Start it.

        Args:
            package: The package with the texts of the editor.
            settings: The selected rules and their severities.
        """
        # Not forked: the server has threads.
        context = multiprocessing.get_context("spawn")
        self._answer, theirs = context.Pipe(duplex=False)
        arguments = (theirs, package, settings)
        self._process = context.Process(target=_check, args=arguments, daemon=True)
        self._process.start()
        theirs.close()

    def result(self) -> PackageReport | WorkerFailed:
        """Wait for the report."""
        try:
            report: PackageReport | WorkerFailed = self._answer.recv()
        except (EOFError, OSError):
            return WorkerFailed("was stopped")
        finally:
            self._process.join()
            self._answer.close()
        return report

    def stop(self) -> None:
        """End it; `result` then reports that it was stopped."""
        with suppress(OSError, ValueError):
            self._process.terminate()


def _check(answer: Connection, package: Package, settings: Settings) -> None:
    """Check, and send the report."""
    from checker.engine.review import judge_package

    cache = Cache(cache_folder()) if settings.cache else NO_CACHE
    try:
        answer.send(judge_package(package, str(package.root), settings, cache, say_nothing))
    except CheckerError as error:
        answer.send(WorkerFailed(str(error)))
