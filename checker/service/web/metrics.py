"""What is counted of requests, in the text format of Prometheus."""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from checker.service.jobs.port import Alive

BOUNDS = (0.005, 0.02, 0.1, 0.5, 2.0, 10.0)
"""Upper bounds of the histogram of durations, in seconds."""


@dataclass
class Metrics:
    """Counts since the process began; used by the event loop alone.

    Attributes:
        uploads: Taken.
        refused: Requests, by their cause.
    """

    uploads: int = 0
    refused: Counter[str] = field(default_factory=Counter)
    _requests: Counter[tuple[str, str, int]] = field(default_factory=Counter)
    _seconds: defaultdict[str, float] = field(default_factory=lambda: defaultdict(float))
    _buckets: Counter[tuple[str, int]] = field(default_factory=Counter)

    def count(self, method: str, route: str, status: int, seconds: float) -> None:
        """Count a request.

        Args:
            method: Of HTTP.
            route: Its template, such as `/checks/{id}`, of which there are few.
            status: Of the answer; 0 if there was none.
            seconds: Until its end.
        """
        self._requests[method, route, status] += 1
        self._seconds[route] += seconds
        self._buckets[route, bisect_left(BOUNDS, seconds)] += 1

    def text(self, alive: Alive | None) -> str:
        """Return all figures.

        Args:
            alive: What is known of the engine; None if it does not answer.
        """
        lines = [*self._of_requests(), *self._of_durations(), *self._of_uploads()]
        lines += _of_engine(alive)
        return "\n".join(lines) + "\n"

    def _of_requests(self) -> Iterator[str]:
        yield from _head("requests_total", "counter", "Requests by method, route and status.")
        for (method, route, status), number in sorted(self._requests.items()):
            labels = {"method": method, "route": route, "status": str(status)}
            yield _sample("requests_total", labels, number)

    def _of_durations(self) -> Iterator[str]:
        name = "request_seconds"
        yield from _head(name, "histogram", "Seconds until the end of the answer, by route.")
        for route, seconds in sorted(self._seconds.items()):
            total = 0
            for at, bound in enumerate((*map(str, BOUNDS), "+Inf")):
                total += self._buckets[route, at]
                yield _sample(f"{name}_bucket", {"route": route, "le": bound}, total)
            yield _sample(f"{name}_sum", {"route": route}, round(seconds, 6))
            yield _sample(f"{name}_count", {"route": route}, total)

    def _of_uploads(self) -> Iterator[str]:
        yield from _head("uploads_total", "counter", "Uploads that were taken.")
        yield _sample("uploads_total", {}, self.uploads)
        yield from _head("refused_total", "counter", "Requests that were refused, by cause.")
        for cause, number in sorted(self.refused.items()):
            yield _sample("refused_total", {"cause": cause}, number)


def _of_engine(alive: Alive | None) -> Iterator[str]:
    yield from _head("engine_up", "gauge", "Whether the job engine answers.")
    yield _sample("engine_up", {}, int(alive is not None))
    if alive is None:
        return
    yield from _head("waiting", "gauge", "Checks that wait, by queue.")
    for queue, number in sorted(alive.waiting.items()):
        yield _sample("waiting", {"queue": queue}, number)
    yield from _head("running", "gauge", "Checks that run.")
    yield _sample("running", {}, alive.running)
    yield from _head("worker_silent_seconds", "gauge", "Since each worker's last sign of life.")
    for worker, seconds in sorted(alive.workers.items()):
        yield _sample("worker_silent_seconds", {"worker": worker}, round(seconds, 3))


def _head(name: str, kind: str, about: str) -> Iterator[str]:
    yield f"# HELP subt_check_{name} {about}"
    yield f"# TYPE subt_check_{name} {kind}"


def _sample(name: str, labels: Mapping[str, str], value: float) -> str:
    shown = ",".join(f'{label}="{_escaped(text)}"' for label, text in labels.items())
    return f"subt_check_{name}{{{shown}}} {value}" if shown else f"subt_check_{name} {value}"


def _escaped(text: str) -> str:
    return text.replace("\\", r"\\").replace('"', r"\"").replace("\n", r"\n")
