"""The roll of workers: who has lately shown a sign of life."""

from __future__ import annotations

from collections.abc import Sequence

import sqlalchemy as sa
from msgspec import to_builtins

from checker.base.record import Record
from checker.base.sandbox.layers import Layer
from checker.service.jobs.durable.database import now
from checker.service.jobs.durable.tables import WORKERS


class Roll(Record):
    """The roll of workers.

    Attributes:
        engine: Of the database.
        layers: Of the sandbox in which this worker checks.
    """

    engine: sa.Engine
    layers: Sequence[Layer] = ()

    def beat(self, worker: str) -> None:
        """Show a sign of life."""
        alive = {"beat": now(self.engine), "layers": [to_builtins(each) for each in self.layers]}
        with self.engine.begin() as connection:
            mine = sa.update(WORKERS).where(WORKERS.c.name == worker).values(alive)
            if connection.execute(mine).rowcount == 0:
                connection.execute(sa.insert(WORKERS).values(name=worker, **alive))

    def living(self, silence: float) -> set[str]:
        """Return who has been silent for less than `silence` seconds."""
        fresh = WORKERS.c.beat > now(self.engine) - silence
        with self.engine.connect() as connection:
            return set(connection.execute(sa.select(WORKERS.c.name).where(fresh)).scalars())

    def strike(self, worker: str) -> None:
        """Take a worker off the roll, which is not one any more."""
        with self.engine.begin() as connection:
            connection.execute(sa.delete(WORKERS).where(WORKERS.c.name == worker))

    def strike_silent(self, silence: float) -> None:
        """Take those off the roll that have been silent for `silence` seconds."""
        silent = WORKERS.c.beat <= now(self.engine) - silence
        with self.engine.begin() as connection:
            connection.execute(sa.delete(WORKERS).where(silent))
