"""How long the stages of checks took lately, by what was told of them."""

from __future__ import annotations

from collections.abc import Mapping
from statistics import median

import sqlalchemy as sa

from checker.service.jobs.durable.database import now
from checker.service.jobs.durable.tables import CHECKS, EVENTS
from checker.service.jobs.port import Pace, Stage

CHECKS_ASKED = 25
"""The last checks that came to a report."""
LATELY_SECONDS = 86_400.0
"""What was ordered before says nothing of now."""
_STATIC, _TRIAL = ("static", "read"), ("trial", "end")
"""Events between which each of the two stages lies."""


def pace_of(engine: sa.Engine) -> Pace:
    """Return how long the stages of the last checks took; a median, as some are out of measure."""
    last = (
        sa.select(CHECKS.c.id)
        .where(CHECKS.c.stage == Stage.DONE.value, CHECKS.c.created > now(engine) - LATELY_SECONDS)
        .order_by(CHECKS.c.created.desc())
        .limit(CHECKS_ASKED)
    )
    told = sa.select(EVENTS.c.check_id, EVENTS.c.key, EVENTS.c.time).where(
        EVENTS.c.check_id.in_(last), EVENTS.c.key.in_(_STATIC + _TRIAL)
    )
    times: dict[str, dict[str, float]] = {}
    with engine.connect() as connection:
        for id, key, time in connection.execute(told):
            times.setdefault(id, {})[key] = time
    found = [*times.values()]
    return Pace(_between(found, *_STATIC), _between(found, *_TRIAL))


def _between(checks: list[dict[str, float]], first: str, last: str) -> float:
    """Return the median of the seconds between two events; what was in the store has not both."""
    seconds = [_seconds(times, first, last) for times in checks if {first, last} <= {*times}]
    return median(seconds) if seconds else 0.0


def _seconds(times: Mapping[str, float], first: str, last: str) -> float:
    return max(0.0, times[last] - times[first])
