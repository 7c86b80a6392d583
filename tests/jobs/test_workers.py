"""Tables of our own: which layers each worker has, and what hides senders."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
import sqlalchemy as sa

from checker.base.sandbox.layers import Layer
from checker.service.jobs.durable.client import durable_jobs
from checker.service.jobs.durable.database import open_database
from checker.service.jobs.durable.senders import RATES, SALTS, Senders
from checker.service.jobs.durable.workers import Workers
from checker.service.store.store import Store
from support.postgres import DATABASES, fresh_database

LAYERS = (Layer("landlock", True, "version 7", hides=True), Layer("account", False, "no root"))


@pytest.fixture(params=DATABASES)
def url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path}/jobs.sqlite"
    return fresh_database(request.getfixturevalue("postgres_url"))


def test_it_knows_the_sandbox_of_each_worker(url: str, tmp_path: Path) -> None:
    jobs = durable_jobs(url, Store(tmp_path))
    Workers(jobs.checks.engine, LAYERS).record_heartbeat("walled")
    Workers(jobs.checks.engine).record_heartbeat("bare")
    Workers(jobs.checks.engine, LAYERS).record_heartbeat("again")
    Workers(jobs.checks.engine).record_heartbeat("again")
    alive = jobs.alive()
    assert alive.layers == {"walled": list(LAYERS), "bare": [], "again": []}
    assert alive.live_workers == alive.layers
    jobs.checks.engine.dispose()


def test_senders_have_the_same_partition_for_a_day(url: str, tmp_path: Path) -> None:
    """As all web processes know them, and no other day does."""
    engine = durable_jobs(url, Store(tmp_path)).checks.engine
    other = open_database(url)
    with ThreadPoolExecutor(4) as pool:
        each = [Senders(engine), Senders(other)] * 4
        found = set(pool.map(lambda senders: senders.digest("somebody"), each))
    assert len(found) == 1
    assert Senders(engine).digest("another") not in found
    assert Senders(engine).digest("") == "nobody"
    with engine.begin() as connection:
        connection.execute(sa.update(SALTS).values(day="2026-01-01"))
    assert Senders(engine).digest("somebody") not in found
    with engine.connect() as connection:
        assert connection.execute(sa.select(sa.func.count()).select_from(SALTS)).scalar() == 1
    for each in (engine, other):
        each.dispose()


@pytest.mark.service
def test_uploads_are_counted_by_all_web_processes_together(
    postgres_url: str, tmp_path: Path
) -> None:
    """Three a minute: three at once, then one each 20 s; other clients have their own."""
    url = fresh_database(postgres_url)
    one, other = (durable_jobs(url, Store(tmp_path)) for _ in range(2))
    assert [each.wait("192.0.2.1", 3) for each in (one, other, one)] == [0.0, 0.0, 0.0]
    assert 15.0 < one.wait("192.0.2.1", 3) <= 20.0
    assert 15.0 < other.wait("192.0.2.1", 3) <= 20.0
    assert other.wait("192.0.2.2", 3) == 0.0
    with one.checks.engine.begin() as connection:
        connection.execute(sa.update(RATES).values(free=RATES.c.free - 20.0))
    assert other.wait("192.0.2.1", 3) == 0.0
    assert one.wait("192.0.2.1", 3) > 15.0
    with one.checks.engine.begin() as connection:
        connection.execute(sa.update(RATES).values(free=0.0))
    one.senders.forget()
    with one.checks.engine.connect() as connection:
        assert connection.execute(sa.select(RATES)).all() == []
    for each in (one, other):
        each.checks.engine.dispose()


@pytest.mark.parametrize(
    "change",
    [
        "ALTER TABLE subt_workers ADD COLUMN later TEXT",
        "ALTER TABLE subt_workers DROP COLUMN drains",
    ],
)
def test_tables_of_another_version_are_made_anew(url: str, tmp_path: Path, change: str) -> None:
    """A newer one has a column more, an older one lacks one; what has our columns stays."""
    store = Store(tmp_path)
    engine = durable_jobs(url, store).checks.engine
    Workers(engine).record_heartbeat("of another version")
    partition = Senders(engine).digest("somebody")
    with engine.begin() as connection:
        connection.exec_driver_sql(change)
    jobs = durable_jobs(url, store)
    assert jobs.alive().workers == {}
    Workers(jobs.checks.engine).record_heartbeat("of this version")
    durable_jobs(url, store).checks.engine.dispose()
    assert [*jobs.alive().workers] == ["of this version"]
    assert Senders(engine).digest("somebody") == partition
    for each in (engine, jobs.checks.engine):
        each.dispose()
