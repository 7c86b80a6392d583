"""Tables of our own, beside those of DBOS: who works, and what hides who sends.

Nothing in them is worth keeping: they are made anew where their columns differ.
"""

from __future__ import annotations

import hmac
import secrets
from collections.abc import Collection, Mapping, Sequence
from datetime import UTC, datetime

import sqlalchemy as sa
from msgspec import to_builtins

from checker.base.record import Record
from checker.base.sandbox.layers import Layer

METADATA = sa.MetaData()
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
SALTS = sa.Table(
    "subt_salts",
    METADATA,
    sa.Column("day", sa.String(10), primary_key=True),
    sa.Column("salt", sa.String(64), nullable=False),
)
"""What senders are hashed with on a day; deleted the day after."""


def now(engine: sa.Engine) -> sa.ColumnElement[float]:
    """Return the database's clock, seconds since the epoch: clocks of machines may differ."""
    if engine.dialect.name == "sqlite":
        return (sa.func.julianday("now", type_=sa.Double) - 2440587.5) * 86400.0
    return sa.cast(sa.extract("epoch", sa.func.clock_timestamp()), sa.Double)


class Workers(Record):
    """The table of workers.

    Attributes:
        engine: Of the database.
        layers: Of the sandbox in which this worker checks.
    """

    engine: sa.Engine
    layers: Sequence[Layer] = ()

    def beat(self, worker: str) -> bool:
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
        """Have workers take nothing new, finish what they have in hand, and end."""
        with self.engine.begin() as connection:
            theirs = sa.update(WORKERS).where(WORKERS.c.name.in_(names))
            connection.execute(theirs.values(drains=True))

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


def partition_of(engine: sa.Engine, sender: str) -> str:
    """Return what stands for a sender in the queues of today; nobody can tell tomorrow who it was.

    Args:
        engine: Of the database.
        sender: Who asks; empty for anybody.
    """
    if not sender:
        return "nobody"
    today = datetime.now(UTC).date().isoformat()
    return hmac.digest(_salt(engine, today).encode(), sender.encode(), "sha256").hex()[:32]


def _salt(engine: sa.Engine, day: str) -> str:
    of_day = sa.select(SALTS.c.salt).where(SALTS.c.day == day)
    while True:
        with engine.connect() as connection:
            if (salt := connection.execute(of_day).scalar()) is not None:
                return str(salt)
        try:
            with engine.begin() as connection:
                new = secrets.token_hex(32)
                connection.execute(sa.insert(SALTS).values(day=day, salt=new))
                connection.execute(sa.delete(SALTS).where(SALTS.c.day < day))
        except sa.exc.IntegrityError:  # another process was faster
            continue
