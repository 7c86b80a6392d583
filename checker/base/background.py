"""Work in the background: its results come from the cache, else from a process with limits.

It starts early, while the caller does something else, or when its results are requested.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Generic, TypeVar

from msgspec import field

from checker.base.cache import Cache, code_hash, key_of
from checker.base.child_process import NONSENSE, Child, Limits, from_json
from checker.base.child_server import Asked, Server
from checker.base.parts import WorkerFailed
from checker.base.record import Record
from checker.base.resources import version_of
from checker.base.sandbox.files import from_disk

T = TypeVar("T")

_NONSENSE = WorkerFailed("answered with nonsense")


def work_key(request: Iterable[bytes | str], code: Iterable[str], libraries: Iterable[str]) -> str:
    """Return the key of a result: a hash of all that it depends on.

    Args:
        request: What is computed.
        code: Folders and files of this program that compute it, relative to `checker`.
        libraries: Names of the distributions that they use.
    """
    return key_of(*request, code_hash(*code), *map(version_of, libraries))


def _always(_: object) -> bool:
    return True


class Work(Record, Generic[T], eq=False):
    """The items that one process computes.

    Its module's `answer` is given JSON: `items`, a list, and `common` data. It answers with
    a JSON list of as many results; in place of one, `failed` states why there is none.

    Attributes:
        kind: The kind of the results in the cache.
        module: The module whose `answer` does the work.
        limits: What the process may use.
        items: The requested items, as JSON, by the key of its result.
        decode: Makes a result of an entry of the answer. It raises one of `NONSENSE` for what is
            none: the answering process may be compromised.
        common: What all items need.
        files: Returns paths of files that go with items, and how many bytes each may have.
        lasts: Whether a result is valid next time too.
        here: Computes one item in this process, where that takes less than to start another.
    """

    kind: str
    module: str
    limits: Limits
    items: Mapping[str, Any]
    decode: Callable[[Any], T]
    common: Mapping[str, Any] = field(default_factory=dict)
    files: Callable[[Any], Iterable[tuple[str, int]]] = lambda _: ()
    lasts: Callable[[T], bool] = _always
    here: Callable[[Any], Any] | None = None


class Background(Generic[T]):
    """Work that may continue while the caller does something else."""

    def __init__(self, work: Work[T], cache: Cache, waiting: Child | Server | None = None) -> None:
        """Begin nothing yet.

        Args:
            work: What to do.
            cache: The cache of results.
            waiting: A process that takes the work; without it one is started. Its owner stops it.
        """
        self._work, self._cache, self._waiting = work, cache, waiting
        self._asked: Child | Asked | None = None
        self._results: dict[str, T | WorkerFailed] = {}
        self._unknown: Sequence[str] | None = None
        self._not_given: WorkerFailed | None = None

    @property
    def known(self) -> bool:
        """True if no process is needed, nor waited for."""
        self.begin()
        return not self._unknown

    def begin(self) -> None:
        """Look up what is known, and compute the rest in a process; `results` waits for it."""
        if self._unknown is not None:
            return
        for key in self._work.items:
            kept = self._cache.get(self._work.kind, key)
            result = self._decoded(kept) if kept is not None else _NONSENSE
            if not isinstance(result, WorkerFailed):
                self._results[key] = result
        unknown = [key for key in self._work.items if key not in self._results]
        if unknown and self._work.here is None:
            self._give([self._work.items[key] for key in unknown])
        self._unknown = unknown

    def results(self) -> Mapping[str, T | WorkerFailed]:
        """Wait for the result of each item, or why it has none; keep those that last."""
        self.begin()
        if self._unknown:
            for key, answer in zip(self._unknown, self._answers(self._unknown), strict=True):
                result = answer if isinstance(answer, WorkerFailed) else self._decoded(answer)
                self._results[key] = result
                if not isinstance(result, WorkerFailed) and self._work.lasts(result):
                    self._cache.put(self._work.kind, key, answer)
                else:
                    self._cache.pass_over(self._work.kind, _disturbance(result))
            self._unknown = ()
        return self._results

    def result(self) -> T | WorkerFailed:
        """Wait for the result of the first item; all have it where there is but one."""
        return next(iter(self.results().values()))

    def stop(self) -> None:
        """Stop the processes that still run."""
        if self._asked is not None:
            self._asked.stop()

    def _give(self, items: Sequence[Any]) -> None:
        work = self._work
        request = json.dumps({**work.common, "items": items}).encode()
        contents = from_disk(dict(file for item in items for file in work.files(item)).items())
        try:
            if self._waiting is None:
                self._asked = Child(work.module, request, work.limits, contents)
            else:
                self._asked = self._waiting.give(request, contents)
        except OSError as error:  # such as a full disk
            self._not_given = WorkerFailed(f"could not be started: {error.strerror}", True)

    def _answers(self, unknown: Sequence[str]) -> Sequence[Any]:
        """Return as many answers as were requested, or why there are none."""
        if self._work.here is not None:
            return [self._work.here(self._work.items[key]) for key in unknown]
        answer = self._asked.answer() if self._asked is not None else self._not_given or _NONSENSE
        if isinstance(answer, WorkerFailed):
            return [answer] * len(unknown)
        try:
            answers = from_json(answer)
        except ValueError:
            answers = None
        fits = isinstance(answers, list) and len(answers) == len(unknown)
        return answers if fits else [_NONSENSE] * len(unknown)

    def _decoded(self, answer: Any) -> T | WorkerFailed:
        match answer:
            case {"failed": {"reason": str(reason), "momentary": bool(momentary)}}:
                return WorkerFailed(reason, momentary)
        try:
            return self._work.decode(answer)
        except NONSENSE:
            return _NONSENSE


def _disturbance(result: object) -> str:
    """Return why there is no result, if the cause is momentary."""
    return result.reason if isinstance(result, WorkerFailed) and result.momentary else ""
