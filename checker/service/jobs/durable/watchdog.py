"""Signs of life, and what workers had in hand that give none any more."""

from __future__ import annotations

import logging

from checker.base.record import Record
from checker.service.jobs.durable.engine import holders, recover
from checker.service.jobs.durable.roll import Roll

_LOG = logging.getLogger(__name__)
_ROLL_SILENCES = 60
"""A dead worker stays on the roll for so many times the silence, for those who look at it."""


class Watchdog(Record):
    """One in each worker; each looks after all others.

    Attributes:
        roll: Of all workers.
        worker: Name of its own.
        silence_seconds: After which a worker counts as dead. Its check counts as begun once more
            when another worker takes it, and is given up after the third death.
    """

    roll: Roll
    worker: str
    silence_seconds: float

    def look(self) -> None:
        """Show a sign of life, then have done by others what the dead had in hand."""
        self.roll.beat(self.worker)
        dead = holders() - self.roll.living(self.silence_seconds)
        if dead:
            _LOG.warning("workers that died: %s; what they had in hand waits again", sorted(dead))
            recover(dead)
        self.roll.strike_silent(_ROLL_SILENCES * self.silence_seconds)
