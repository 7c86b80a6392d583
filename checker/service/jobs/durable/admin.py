"""Listing and changes of the checks in a database, for operators."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from time import time

from msgspec import field
from msgspec.structs import replace

from checker.base.errors import CheckerError
from checker.base.record import Record
from checker.service.jobs.durable.checks import Checks
from checker.service.jobs.durable.receipts import key_of_check
from checker.service.jobs.durable.stages import retry_until_answered
from checker.service.jobs.durable.tasks import Row, state_of
from checker.service.jobs.durable.workers import Workers
from checker.service.jobs.port import SILENCE_SECONDS, Stage, State

_AT_ONCE = 200
_FAILED = "it failed before"
_OVER_WELL = (Stage.DONE, Stage.REFUSED, Stage.CANCELLED)


class Listed(Record):
    """A check that is not over, or has failed.

    Attributes:
        key: The key of the check.
        stage: The stage, as in `port.Stage`.
        number: The number of the try of that stage.
        age: Seconds since it was ordered.
        worker: The worker that runs it or ran it last; empty if it waits.
        words: The description of its state.
    """

    key: str
    stage: Stage
    number: int = field(name="try")
    age: float
    worker: str
    words: str


class Admin(Record):
    """The checks and workers of a service.

    Attributes:
        checks: The checks in the database.
        workers: The workers in the same database.
    """

    checks: Checks
    workers: Workers

    def list_checks(self) -> Iterator[Listed]:
        """Yield the checks that wait, run or have failed, those first that were ordered first."""
        known, over = set[str](), set[str]()
        for row in self.checks.all_rows():
            (over if row.end and row.end.stage in _OVER_WELL else known).add(row.task.key)
        found = [
            (state, rows[-1])
            for state, rows in self._states(known - over)
            if state.stage not in _OVER_WELL
        ]
        for state, last in sorted(found, key=lambda each: each[0].created):
            worker = last.executor if last.begun else ""
            age = round(time() - state.created, 1)
            yield Listed(state.id, state.stage, last.task.number, age, worker, state.words)

    def keys_of(self, names: Sequence[str], *, over: bool) -> Sequence[str]:
        """Return the keys of checks that failed, or of those that are not over.

        Args:
            names: Keys, beginnings of keys, or ids.
            over: Whether they must have failed.

        Raises:
            CheckerError: One of them is not the name of one such check.
        """
        known = {row.task.key for row in self.checks.all_rows()}
        keys = [_key_of(name, known) for name in names]
        expected = "one that has failed" if over else "one that waits or runs"
        for state, _ in self._states(keys):
            if (state.stage is not Stage.FAILED) if over else state.stage.is_final:
                raise CheckerError(f"the check {state.id} is {state.stage}, expected {expected}")
        return keys

    def requeue(self, key: str) -> None:
        """Begin a failed check again, under the same link, with all tries but one."""
        [first, *others] = self.checks.rows([key])[key]
        self.checks.client.delete_workflows([row.task.id for row in others])
        # The first row contains the order: it stays in any case.
        retry_until_answered(lambda: self.checks.retry(replace(first.task, end=None), _FAILED))

    def drain(self, names: Sequence[str]) -> Sequence[str]:
        """End workers after their running tasks, and return their names.

        Args:
            names: The names of workers, with or without what each process adds; none for all.

        Raises:
            CheckerError: No worker of that name runs.
        """
        living = self.workers.live_workers(SILENCE_SECONDS)
        for name in names:
            if not any(_is_called(each, name) for each in living):
                them = ", ".join(sorted(living)) or "none"
                raise CheckerError(f"no worker {name} is alive, expected one of: {them}")
        chosen = [each for each in living if not names or any(_is_called(each, n) for n in names)]
        self.workers.drain(chosen)
        return sorted(chosen)

    def _states(self, keys: Collection[str]) -> Iterator[tuple[State, Sequence[Row]]]:
        """Yield the states of checks, by their keys, and their rows."""
        unique_keys = sorted({*keys})
        for start in range(0, len(unique_keys), _AT_ONCE):
            for key, rows in self.checks.rows(unique_keys[start : start + _AT_ONCE]).items():
                if state := state_of(key, rows):
                    yield state, rows


def _key_of(name: str, known: Collection[str]) -> str:
    """Return the key that is meant."""
    of_id = key_of_check(name)
    found = [of_id] if of_id in known else [key for key in known if name and key.startswith(name)]
    if len(found) != 1:
        many = "more than one check has" if found else "no check has"
        raise CheckerError(f"{many} the key {name!r}; `subt-check admin list` shows keys")
    return found[0]


def _is_called(worker: str, name: str) -> bool:
    return name in (worker, worker.rpartition("-")[0])
