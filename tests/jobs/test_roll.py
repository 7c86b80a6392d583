"""The roll of workers says which layers each of them has."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
import sqlalchemy as sa

from checker.base.sandbox.layers import Layer
from checker.service.jobs.durable.client import durable_jobs
from checker.service.jobs.durable.database import open_database, prepare
from checker.service.jobs.durable.roll import Roll
from checker.service.store.store import Store
from tests.postgres import DATABASES, fresh_database

LAYERS = (Layer("landlock", True, "version 7", hides=True), Layer("account", False, "no root"))
OLD = sa.text("INSERT INTO subt_workers (name, beat) VALUES ('old', 1e9)")


@pytest.fixture(params=DATABASES)
def url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path}/jobs.sqlite"
    return fresh_database(request.getfixturevalue("postgres_url"))


def test_it_knows_the_sandbox_of_each_worker(url: str, tmp_path: Path) -> None:
    jobs = durable_jobs(url, Store(tmp_path))
    Roll(jobs.engine, LAYERS).beat("walled")
    Roll(jobs.engine).beat("bare")
    Roll(jobs.engine, LAYERS).beat("again")
    Roll(jobs.engine).beat("again")
    alive = jobs.alive()
    assert alive.layers == {"walled": list(LAYERS), "bare": [], "again": []}
    assert alive.living == alive.layers
    jobs.engine.dispose()


def test_workers_of_version_0_1_0_go_on_and_name_no_layers(url: str, tmp_path: Path) -> None:
    engine = open_database(url)
    prepare(engine)
    with engine.begin() as connection:
        connection.execute(sa.text("ALTER TABLE subt_workers DROP COLUMN layers"))
        connection.execute(OLD)
    engines = [engine, *(open_database(url) for _ in range(3))]
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(prepare, engines))
    with engine.begin() as connection:
        connection.execute(sa.text("UPDATE subt_workers SET beat = 2e9 WHERE name = 'old'"))
    Roll(engine, LAYERS).beat("new")
    jobs = durable_jobs(url, Store(tmp_path))
    assert jobs.alive().layers == {"old": [], "new": list(LAYERS)}
    for each in (*engines, jobs.engine):
        each.dispose()
