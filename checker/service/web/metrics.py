"""Counters of requests of the web process, for Prometheus, from zero when it starts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from prometheus_client import CollectorRegistry, Counter, Histogram, generate_latest
from prometheus_client.core import GaugeMetricFamily

from checker.base.record import Record
from checker.service.jobs.port import Alive

BOUNDS = (0.005, 0.02, 0.1, 0.5, 2.0, 10.0)
"""Upper bounds of the histogram of durations, in seconds."""
_OURS = "subt_check"


class Metrics:
    """Counts since the service began.

    Attributes:
        uploads: Taken.
        refused: Requests, by their cause.
    """

    def __init__(self) -> None:
        self._registry = CollectorRegistry()
        own: dict[str, Any] = {"namespace": _OURS, "registry": self._registry}
        self._requests = Counter(
            "requests_total",
            "Requests by method, route and status.",
            ("method", "route", "status"),
            **own,
        )
        self._seconds = Histogram(
            "request_seconds",
            "Seconds until the end of the answer, by route.",
            ("route",),
            buckets=BOUNDS,
            **own,
        )
        self.uploads = Counter("uploads_total", "Uploads that were taken.", **own)
        self.refused = Counter(
            "refused_total", "Requests that were refused, by cause.", ("cause",), **own
        )

    def count(self, method: str, route: str, status: int, seconds: float) -> None:
        """Count a request.

        Args:
            method: The HTTP method.
            route: Its template, such as `/checks/{id}`, of which there are few.
            status: The status of the answer; 0 if there was none.
            seconds: Seconds until its end.
        """
        self._requests.labels(method, route, status).inc()
        self._seconds.labels(route).observe(seconds)

    def text(self, alive: Alive | None, stage_seconds: Mapping[str, float]) -> bytes:
        """Return all figures.

        Args:
            alive: What is known of the engine; None if it does not answer.
            stage_seconds: Median of what stages took lately.
        """
        return generate_latest(self._registry) + generate_latest(_Engine(alive, stage_seconds))


class _Engine(Record):
    """Figures of the engine: not counted, but read each time."""

    alive: Alive | None
    stage_seconds: Mapping[str, float]

    def collect(self) -> Iterator[GaugeMetricFamily]:
        alive = self.alive
        yield _gauge("engine_up", "Whether the job engine answers.", int(alive is not None))
        if alive is not None:
            yield _gauge("running", "Checks that run.", alive.running)
            yield _gauges("waiting", "Checks that wait, by queue.", "queue", alive.waiting)
            about = "Since each worker's last sign of life."
            yield _gauges("worker_silent_seconds", about, "worker", alive.workers)
            about = "Median of what stages took lately, without waiting, by stage."
            yield _gauges("stage_seconds", about, "stage", self.stage_seconds)


def _gauge(name: str, about: str, value: float) -> GaugeMetricFamily:
    return GaugeMetricFamily(f"{_OURS}_{name}", about, value)


def _gauges(name: str, about: str, label: str, values: Mapping[str, float]) -> GaugeMetricFamily:
    family = GaugeMetricFamily(f"{_OURS}_{name}", about, labels=(label,))
    for key, value in sorted(values.items()):
        family.add_metric((key,), value)
    return family
