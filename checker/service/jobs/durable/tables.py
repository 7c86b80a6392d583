"""The ledger's tables, beside those of DBOS in the same database."""

from __future__ import annotations

import sqlalchemy as sa

METADATA = sa.MetaData()

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
)
"""Each check. `id` is its key, which opens nothing (`keys.py`). `worker` has it
in hand; empty while it waits or when it is over. `turn` goes up whenever it changes hands: who
holds an older one has lost it. `losses` are the workers that died with it in hand."""

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

WORKERS = sa.Table(
    "subt_workers",
    METADATA,
    sa.Column("name", sa.String(128), primary_key=True),
    sa.Column("beat", sa.Double, nullable=False),
    sa.Column("layers", sa.JSON),
)
"""The last sign of life of each worker, by the clock of the database, and layers of its sandbox;
version 0.1.0 knows none."""


def make_tables(connection: sa.Connection) -> None:
    """Make what is missing: tables, and the column that those of version 0.1.0 lack."""
    METADATA.create_all(connection)
    known = {column["name"] for column in sa.inspect(connection).get_columns(WORKERS.name)}
    if WORKERS.c.layers.name not in known:
        connection.exec_driver_sql("ALTER TABLE subt_workers ADD COLUMN layers JSON")
