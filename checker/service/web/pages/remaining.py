"""How long a check that waits will still take, where that can be said."""

from __future__ import annotations

from threading import Lock
from time import monotonic

from checker.base.words import count
from checker.service.jobs.port import Alive, Jobs, Pace, Stage, State

FRESH_SECONDS = 20.0
"""For so long one answer of the engine does for all who wait."""
_MINUTE, _HOUR = 60.0, 3600.0


def remaining(state: State, pace: Pace, alive: Alive) -> float | None:
    """Return the seconds until the report of a check that waits; None where nobody knows.

    Static rules and trials are worked on at the same time, so that the slower of the two sets how
    fast a queue gets shorter.

    Args:
        state: Of the check.
        pace: Of checks lately.
        alive: Tells how many workers there are, and how many checks wait for their trial.
    """
    workers = len(alive.living)
    waits = state.stage is Stage.QUEUED or state.ahead > 0
    if state.stage.is_final or not waits or not workers or not pace.trial:
        return None
    if state.stage is Stage.TRIAL:
        return (1 + state.ahead // workers) * pace.trial
    ahead = state.ahead + alive.waiting.get(Stage.TRIAL.value, 0)
    return pace.static + pace.trial + ahead // workers * max(pace.static, pace.trial)


def in_words(seconds: float) -> str:
    """Return a time as people say it: nobody can know it to the second."""
    if seconds <= _MINUTE:
        return "less than a minute"
    if seconds < _HOUR:
        return f"about {count(round(seconds / _MINUTE), 'minute')}"
    return f"about {count(round(seconds / _HOUR), 'hour')}"


class Forecast:
    """Says how long checks will take; asks the engine once for all who wait."""

    def __init__(self, jobs: Jobs) -> None:
        self._jobs = jobs
        self._lock = Lock()
        self._known: tuple[float, Pace, Alive] | None = None

    def of(self, state: State) -> str:
        """Return how long a check that waits will take, in words; empty where nobody knows.

        Raises:
            JobsUnreachable: The database does not answer.
        """
        if state.stage.is_final:
            return ""
        seconds = remaining(state, *self._now())
        return "" if seconds is None else in_words(seconds)

    def _now(self) -> tuple[Pace, Alive]:
        with self._lock:
            if self._known is None or monotonic() - self._known[0] > FRESH_SECONDS:
                self._known = (monotonic(), self._jobs.pace(), self._jobs.alive())
            return self._known[1:]
