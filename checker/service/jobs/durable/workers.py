"""The table of workers: signs of life, and the layers of their sandboxes."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import sqlalchemy as sa
from msgspec import to_builtins

from checker.base.record import Record
from checker.base.sandbox.layers import Layer
from checker.service.jobs.durable.database import METADATA, now

WORKERS = sa.Table(
    "subt_workers",
    METADATA,
    sa.Column("name", sa.String(128), primary_key=True),
    sa.Column("beat", sa.Double, nullable=False),
    sa.Column("layers", sa.JSON),
    sa.Column("drains", sa.Boolean),
)
"""The last sign of life of each worker, by the clock of the database, layers of its sandbox, and
whether it is to end once its checks are finished."""


class Workers(Record):
    """The table of workers.

    Attributes:
        engine: The engine of the database.
        layers: The layers of the sandbox in which this worker checks.
    """

    engine: sa.Engine
    layers: Sequence[Layer] = ()

    def record_heartbeat(self, worker: str) -> bool:
        """Show a sign of life; return whether this worker is to end."""
        layers = [to_builtins(layer) for layer in self.layers]
        alive = {"beat": now(self.engine), "layers": layers}
        with self.engine.begin() as connection:
            mine = sa.update(WORKERS).where(WORKERS.c.name == worker).values(alive)
            known = connection.execute(mine.returning(WORKERS.c.drains)).first()
            if known is None:
                connection.execute(sa.insert(WORKERS).values(name=worker, **alive))
        return known is not None and bool(known.drains)

    def drain(self, names: Collection[str]) -> None:
        """Notify workers to take no new task, finish running ones, and end."""
        with self.engine.begin() as connection:
            theirs = sa.update(WORKERS).where(WORKERS.c.name.in_(names))
            connection.execute(theirs.values(drains=True))

    def live_workers(self, silence: float) -> set[str]:
        """Return the workers that have been silent for less than `silence` seconds."""
        fresh = WORKERS.c.beat > now(self.engine) - silence
        with self.engine.connect() as connection:
            return set(connection.execute(sa.select(WORKERS.c.name).where(fresh)).scalars())

    def strike(self, worker: str) -> None:
        """Remove a worker that has ended."""
        with self.engine.begin() as connection:
            connection.execute(sa.delete(WORKERS).where(WORKERS.c.name == worker))

    def strike_silent(self, silence: float) -> None:
        """Remove those that have been silent for `silence` seconds."""
        silent = WORKERS.c.beat <= now(self.engine) - silence
        with self.engine.begin() as connection:
            connection.execute(sa.delete(WORKERS).where(silent))

    def worker_states(self) -> tuple[Mapping[str, float], Mapping[str, Sequence[Layer]]]:
        """Return for how many seconds each worker has been silent, and its layers."""
        silence = (now(self.engine) - WORKERS.c.beat).label("silence")
        with self.engine.connect() as connection:
            rows = connection.execute(sa.select(WORKERS.c.name, silence, WORKERS.c.layers)).all()
        layers = {row.name: [Layer(**data) for data in row.layers or ()] for row in rows}
        return {row.name: max(0.0, row.silence) for row in rows}, layers
