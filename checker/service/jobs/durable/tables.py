"""The tables of the service, and the digests that are the keys of checks."""

from __future__ import annotations

from hashlib import sha256

import sqlalchemy as sa

from checker.service.jobs.port import Stage

# What stands for a check in the books: a digest of its id, which opens no report.
#
# The id is in the answer to who uploads and in the addresses that they pass on, and nowhere else.


LENGTH = 64
"""Characters of a key; an id has 22."""
_DOMAIN = b"subt-check: key of a check\0"
"""Keeps keys apart from other digests of ids, such as those in logs."""


def key_of_check(id: str) -> str:
    """Return the key of a check: SHA-256, hexadecimal.

    A plain digest is enough. An id is 128 random bits: who has its digest would have to try 2¹²⁷ of
    them, so that neither salt nor a slow function would add anything.

    Args:
        id: As it was given to who uploaded, or whatever a client sends for one.
    """
    return sha256(_DOMAIN + id.encode("utf-8", "surrogatepass")).hexdigest()


METADATA = sa.MetaData()
STAGES = (Stage.STATIC, Stage.TRIAL)
"""Each has a queue."""
FINAL = [stage.value for stage in Stage if stage.is_final]
"""How the table calls checks that are over."""
WAITS = "waiting in the queue"
"""Said of a check that nobody has in hand."""

CHECKS = sa.Table(
    "subt_checks",
    METADATA,
    sa.Column("id", sa.String(64), primary_key=True),
    sa.Column("upload", sa.Text, nullable=False),
    sa.Column("name", sa.Text, nullable=False),
    sa.Column("profile", sa.Text, nullable=False),
    sa.Column("stage", sa.String(16), nullable=False, index=True),
    sa.Column("words", sa.Text, nullable=False),
    sa.Column("created", sa.Double, nullable=False),
    sa.Column("expires", sa.Double, nullable=False, index=True),
    sa.Column("result", sa.Text, nullable=False, default=""),
    sa.Column("packages", sa.JSON, nullable=False, default=list),
    sa.Column("worker", sa.Text, nullable=False, default=""),
    sa.Column("turn", sa.Integer, nullable=False, default=0),
    sa.Column("losses", sa.JSON, nullable=False, default=list),
    sa.Column("secret", sa.Text, nullable=False, server_default=""),
    sa.Column("sender", sa.String(64), nullable=False, server_default=""),
    sa.Column("cost", sa.Double, nullable=False, server_default="0"),
    sa.Column("rank", sa.Double, nullable=False, server_default="0"),
    sa.Column("tries", sa.Integer, nullable=False, server_default="0"),
    sa.Column("not_before", sa.Double, nullable=False, server_default="0"),
)
"""Each check. `id` is its key, which opens nothing, and `secret` a digest of its secret; checks of
version 0.1.0 have none. `worker` has it in hand; empty while it waits or when it is over. `losses`
are the tries that came to nothing through no fault of the package, and `tries` is their number; it
is not tried again before `not_before`. `sender` is who asked (see `Order`), until it is over;
`cost` is what the next stage takes, in seconds as far as one can tell, and `rank` its place in the
queue (`checker.service.jobs.durable.queue`). Version 0.1.0 wrote `turn`."""

EVENTS = sa.Table(
    "subt_events",
    METADATA,
    sa.Column("check_id", sa.String(64), primary_key=True),
    sa.Column("number", sa.Integer, primary_key=True, autoincrement=False),
    sa.Column("key", sa.String(32), nullable=False),
    sa.Column("stage", sa.String(16), nullable=False),
    sa.Column("words", sa.Text, nullable=False),
    sa.Column("time", sa.Double, nullable=False),
    sa.Column("data", sa.JSON, nullable=False),
    sa.UniqueConstraint("check_id", "key"),
)
"""What happened to each check. A stage that is repeated finds its `key` and tells nothing again."""

QUEUES = sa.Table(
    "subt_queues",
    METADATA,
    sa.Column("stage", sa.String(16), primary_key=True),
    sa.Column("moment", sa.Double, nullable=False),
)
"""The queue of each stage, and its clock: the highest rank of all that was taken from it."""

WORKERS = sa.Table(
    "subt_workers",
    METADATA,
    sa.Column("name", sa.String(128), primary_key=True),
    sa.Column("beat", sa.Double, nullable=False),
    sa.Column("layers", sa.JSON),
    sa.Column("host", sa.Text),
)
"""The last sign of life of each worker, by the clock of the database, layers of its sandbox, and
the machine it runs on; version 0.1.0 knows none of the last two."""


def make_tables(connection: sa.Connection) -> None:
    """Make what is missing: tables, and the columns that those of older versions lack."""
    METADATA.create_all(connection)
    for table in METADATA.sorted_tables:
        known = {column["name"] for column in sa.inspect(connection).get_columns(table.name)}
        for column in table.columns:
            if column.name not in known:
                made = sa.schema.CreateColumn(column).compile(dialect=connection.dialect)
                connection.exec_driver_sql(f"ALTER TABLE {table.name} ADD COLUMN {made}")
    queues = set(connection.execute(sa.select(QUEUES.c.stage)).scalars())
    for stage in STAGES:
        if stage.value not in queues:
            connection.execute(sa.insert(QUEUES).values(stage=stage.value, moment=0.0))
