"""Senders in the database: a digest for the day, and the rate of their uploads.

Each digest depends on a salt that is deleted after the day: the sender cannot be identified later.
"""

from __future__ import annotations

import hmac
import secrets
from datetime import UTC, datetime

import msgspec
import sqlalchemy as sa
from sqlalchemy.dialects.postgresql import insert

from checker.base.record import Record
from checker.service.jobs.durable.database import METADATA, now

SALTS = sa.Table(
    "subt_salts",
    METADATA,
    sa.Column("day", sa.String(10), primary_key=True),
    sa.Column("salt", sa.String(64), nullable=False),
)
"""Salts of the digests of senders, by day."""
RATES = sa.Table(
    "subt_rates",
    METADATA,
    sa.Column("client", sa.String(32), primary_key=True),
    sa.Column("free", sa.Double, nullable=False),
)
"""Time at which each client may again send a whole minute's uploads at once, seconds since the
epoch."""
_MINUTE = 60.0


class Senders(Record):
    """Senders, as the web processes that share a database know them.

    Attributes:
        engine: The engine of the database.
    """

    engine: sa.Engine
    _salts: dict[str, str] = msgspec.field(default_factory=dict)

    def digest(self, sender: str) -> str:
        """Return the digest of a sender for today; "nobody" for an empty name."""
        if not sender:
            return "nobody"
        today = datetime.now(UTC).date().isoformat()
        if today not in self._salts:
            self._salts.clear()
            self._salts[today] = self._salt(today)
        return hmac.digest(self._salts[today].encode(), sender.encode(), "sha256").hex()[:32]

    def wait(self, client: str, per_minute: int) -> float:
        """Count an upload of a client, and return 0; or the seconds until one is allowed.

        The generic cell rate algorithm (ITU-T I.371): each upload moves the client's time by its
        share of a minute, and it may be at most a minute ahead.

        Args:
            client: The client for whom it counts.
            per_minute: Uploads that a client may send.
        """
        share, moment, who = _MINUTE / per_minute, now(self.engine), self.digest(client)
        free = sa.func.greatest(RATES.c.free, moment) + share
        counted = insert(RATES).values(client=who, free=moment + share)
        counted = counted.on_conflict_do_update(
            index_elements=[RATES.c.client], set_={"free": free}, where=free - moment <= _MINUTE
        )
        left = sa.select(RATES.c.free - moment).where(RATES.c.client == who)
        with self.engine.begin() as connection:
            if connection.execute(counted.returning(RATES.c.free)).first() is not None:
                return 0.0
            return float(connection.execute(left).scalar_one()) + share - _MINUTE

    def forget(self) -> None:
        """Delete the counts that refuse nothing any more."""
        with self.engine.begin() as connection:
            connection.execute(sa.delete(RATES).where(RATES.c.free < now(self.engine)))

    def _salt(self, day: str) -> str:
        of_day = sa.select(SALTS.c.salt).where(SALTS.c.day == day)
        while True:
            with self.engine.connect() as connection:
                if (salt := connection.execute(of_day).scalar()) is not None:
                    return str(salt)
            try:
                with self.engine.begin() as connection:
                    new = secrets.token_hex(32)
                    connection.execute(sa.insert(SALTS).values(day=day, salt=new))
                    connection.execute(sa.delete(SALTS).where(SALTS.c.day < day))
            except sa.exc.IntegrityError:  # another process was faster
                continue
