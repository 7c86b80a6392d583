"""Who waits hears of each change, loses nothing with a connection, and costs next to nothing."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import sqlalchemy as sa

from checker.service.jobs.durable.changes import AWAY_SECONDS, CHANNEL, Changes
from checker.service.jobs.durable.checks import Checks
from checker.service.jobs.durable.database import open_database, prepare
from checker.service.jobs.durable.steps import Step, Taker
from checker.service.jobs.port import Order, Stage
from tests.effort import limited
from tests.postgres import DATABASES, fresh_database

LONG = 30.0
KEY = "a" * 64


@pytest.fixture(params=DATABASES)
def engine(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[sa.Engine]:
    if request.param == "sqlite":
        url = f"sqlite:///{tmp_path}/jobs.sqlite"
    else:
        url = fresh_database(request.getfixturevalue("postgres_url"))
    made = open_database(url)
    prepare(made)
    yield made
    made.dispose()


@pytest.fixture
def changes(engine: sa.Engine) -> Iterator[Changes]:
    """Of a database to which it is connected, with nothing new."""
    made = Changes(engine)
    assert made.wait(LONG), "what happened before a connection was not heard"
    assert not made.wait(0.0)
    yield made
    made.close()


def enter(engine: sa.Engine, key: str = KEY) -> None:
    queued = Step("queued", Stage.QUEUED, "waits")
    Checks(engine).enter(key, "1" * 64, Order("0" * 64, "robot.zip"), 60.0, queued, 1.0)


def test_a_new_check_and_each_of_its_steps_is_a_change(engine: sa.Engine, changes: Changes) -> None:
    enter(engine)
    assert changes.wait(LONG)
    held = Checks(engine).take(Taker("w1", "here"), Stage.STATIC)
    assert held is not None
    assert changes.wait(LONG)
    assert Checks(engine).settle(held, Step("end", Stage.DONE, "ready", "b" * 64))
    assert changes.wait(LONG)
    assert not changes.wait(0.0)


def test_who_waits_is_woken(engine: sa.Engine, changes: Changes) -> None:
    later = threading.Timer(0.3, enter, (engine,))
    later.start()
    began = time.monotonic()
    assert changes.wait(LONG)
    assert time.monotonic() - began < LONG / 2
    later.join()


def test_many_changes_are_heard_of_as_one(engine: sa.Engine, changes: Changes) -> None:
    for number in range(20):
        enter(engine, f"{number}")
    assert changes.wait(LONG)
    heard = sum(changes.wait(0.0) for _ in range(20))
    assert heard <= 1, "PostgreSQL may bring them in two pieces"


def test_what_is_taken_back_is_none(engine: sa.Engine, changes: Changes) -> None:
    enter(engine)
    assert changes.wait(LONG)
    assert not changes.wait(0.3)
    enter(engine)  # it is there already
    assert not changes.wait(0.3)


def test_reading_is_none(engine: sa.Engine, changes: Changes) -> None:
    assert Checks(engine).state(KEY) is None
    assert not changes.wait(0.3)


def test_after_its_end_nobody_waits(changes: Changes) -> None:
    heard: list[bool] = []
    waits = threading.Thread(target=lambda: heard.append(changes.wait(LONG)))
    waits.start()
    changes.close()
    waits.join(LONG / 2)
    assert heard == [False]
    assert not changes.wait(LONG)


def test_one_that_waits_costs_next_to_nothing(changes: Changes) -> None:
    with limited(0.02):  # 1 % of a processor; a poll without a pause would take all of it
        assert not changes.wait(2.0)


def test_it_takes_no_connection_of_the_pool(engine: sa.Engine, changes: Changes) -> None:
    assert changes.wait(0.0) is False
    assert isinstance(engine.pool, sa.QueuePool)
    assert engine.pool.checkedout() == 0


@pytest.mark.service
def test_a_lost_connection_counts_as_a_change_and_is_made_anew(postgres_url: str) -> None:
    engine = open_database(fresh_database(postgres_url))
    prepare(engine)
    changes = Changes(engine)
    assert changes.wait(LONG)
    cut = sa.text("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE query = :listens")
    with engine.begin() as connection:
        assert connection.execute(cut, {"listens": f"LISTEN {CHANNEL}"}).scalars().all() == [True]
    assert changes.wait(LONG), "the loss"
    assert changes.wait(LONG), "the new connection"
    assert not changes.wait(0.0)
    enter(engine)
    assert changes.wait(LONG)
    changes.close()
    engine.dispose()


def test_a_database_that_is_away_is_asked_once_a_second(tmp_path: Path) -> None:
    engine = open_database(f"sqlite:///{tmp_path}/data/jobs.sqlite")
    (tmp_path / "data").rename(tmp_path / "gone")
    changes = Changes(engine)
    began = time.monotonic()
    assert changes.wait(0.0)
    assert time.monotonic() - began >= AWAY_SECONDS
    (tmp_path / "gone").rename(tmp_path / "data")
    assert changes.wait(0.0)
    assert not changes.wait(0.0)
    changes.close()
    engine.dispose()
