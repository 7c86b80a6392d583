"""The table of workers: who has lately shown a sign of life."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sqlalchemy as sa
from msgspec import to_builtins

from checker.base.record import Record
from checker.base.sandbox.layers import Layer
from checker.service.jobs.durable.database import now
from checker.service.jobs.durable.tables import WORKERS


class Workers(Record):
    """The table of workers.

    Attributes:
        engine: Of the database.
        layers: Of the sandbox in which this worker checks.
        host: The machine that it runs on.
    """

    engine: sa.Engine
    layers: Sequence[Layer] = ()
    host: str = ""

    def beat(self, worker: str) -> None:
        """Show a sign of life."""
        layers = [to_builtins(layer) for layer in self.layers]
        alive = {"beat": now(self.engine), "layers": layers, "host": self.host}
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
        """Strike a worker out, which is not one any more."""
        with self.engine.begin() as connection:
            connection.execute(sa.delete(WORKERS).where(WORKERS.c.name == worker))

    def strike_silent(self, silence: float) -> None:
        """Strike those out that have been silent for `silence` seconds."""
        silent = WORKERS.c.beat <= now(self.engine) - silence
        with self.engine.begin() as connection:
            connection.execute(sa.delete(WORKERS).where(silent))

    def known(self) -> tuple[Mapping[str, float], Mapping[str, Sequence[Layer]]]:
        """Return for how many seconds each worker has been silent, and its layers."""
        silence = (now(self.engine) - WORKERS.c.beat).label("silence")
        with self.engine.connect() as connection:
            rows = connection.execute(sa.select(WORKERS.c.name, silence, WORKERS.c.layers)).all()
        layers = {row.name: [Layer(**data) for data in row.layers or ()] for row in rows}
        return {row.name: max(0.0, row.silence) for row in rows}, layers
