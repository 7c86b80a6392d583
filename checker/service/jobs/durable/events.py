"""The table of events: what was told of each check, numbered from 1."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from typing import Any

import sqlalchemy as sa

from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.service.jobs.durable.changes import tell
from checker.service.jobs.durable.database import now
from checker.service.jobs.durable.steps import Step
from checker.service.jobs.durable.tables import EVENTS
from checker.service.jobs.port import Event, Stage

_AT_ONCE = 100
_WORDS_LIMIT = 2000


class Events(Record, dict=True):
    """The table of events.

    Attributes:
        engine: Of the database.
    """

    engine: sa.Engine

    def write(self, connection: sa.Connection, id: str, step: Step) -> None:
        """Write an event, unless it was told before; the check's row is locked by now."""
        event = {
            "its_check": id,
            "its_key": step.key,
            "its_stage": step.stage.value,
            "its_words": storable(step.words),
            "its_data": dict(step.data),
        }
        connection.execute(self._telling, event)
        tell(connection, id)

    def after(self, id: str, number: int) -> Sequence[Event]:
        """Return what was told of a check after an event of some number, in order."""
        events = sa.select(EVENTS).where(EVENTS.c.check_id == id, EVENTS.c.number > number)
        with self.engine.connect() as connection:
            rows = connection.execute(events.order_by(EVENTS.c.number).limit(_AT_ONCE))
            return [
                Event(row.number, Stage(row.stage), row.words, row.time, row.data) for row in rows
            ]

    def last(self, ids: Collection[str]) -> Mapping[str, int]:
        """Return the number of the last event of each of these checks that is known."""
        last = sa.func.max(EVENTS.c.number).label("last")
        these = sa.select(EVENTS.c.check_id, last).where(EVENTS.c.check_id.in_(ids))
        question = these.group_by(EVENTS.c.check_id)
        with self.engine.connect() as connection:
            return {row.check_id: row.last for row in connection.execute(question)}

    @cached_property
    def _telling(self) -> sa.Insert:
        """What writes an event."""
        check = sa.bindparam("its_check", type_=sa.Text)
        key = sa.bindparam("its_key", type_=sa.Text)
        exists = sa.exists().where(EVENTS.c.check_id == check, EVENTS.c.key == key)
        last = sa.select(sa.func.max(EVENTS.c.number)).where(EVENTS.c.check_id == check)
        event: dict[str, sa.ColumnElement[Any]] = {
            "check_id": check,
            "number": sa.func.coalesce(last.scalar_subquery(), 0) + 1,
            "key": key,
            "stage": sa.bindparam("its_stage", type_=sa.Text),
            "words": sa.bindparam("its_words", type_=sa.Text),
            "time": now(self.engine),
            "data": sa.bindparam("its_data", type_=sa.JSON),
        }
        chosen = sa.select(*event.values()).where(~exists)
        return sa.insert(EVENTS).from_select(list(event), chosen)


def storable(words: str) -> str:
    """Return words as any database takes them: PostgreSQL refuses a zero character."""
    return shortened(plain(words), _WORDS_LIMIT)
