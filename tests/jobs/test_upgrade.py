"""Books in which ids stand in the clear: old links go on, and the ids are gone."""

from __future__ import annotations

import secrets
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
import sqlalchemy as sa

from checker.service.jobs.durable.client import durable_jobs
from checker.service.jobs.durable.database import open_database, prepare
from checker.service.jobs.durable.tables import key_of_check
from checker.service.jobs.port import Order, Stage
from checker.service.store.store import Store
from tests.jobs.quick_worker import WORDS
from tests.jobs.site import Site, site_in
from tests.postgres import DATABASES, dump, fresh_database

CHECK = """INSERT INTO subt_checks (id, upload, name, profile, stage, words, created, expires,
    result, packages, worker, turn, losses) VALUES (:id, :upload, :name, '', :stage, :words,
    :created, 4e9, '', '[]', :worker, :turn, '[]')"""
EVENT = """INSERT INTO subt_events (check_id, number, key, stage, words, time, data)
    VALUES (:id, 1, 'queued', 'queued', 'waiting in the queue', 1e9, '{}')"""
LIBRARY = """CREATE TABLE {0}workflow_status (workflow_uuid TEXT PRIMARY KEY, name TEXT NOT NULL,
    status TEXT NOT NULL)"""
QUEUED = "INSERT INTO {0}workflow_status VALUES (:id, :name, :status)"
"""What there is of the library's tables that tells of a check."""
STAGES = {
    "waits": ("queued", "waiting in the queue", "", Stage.STATIC),
    "is read": ("static", "the rules look at it", "dead", Stage.STATIC),
    "waits for its trial": ("trial", "the trial is waiting in the queue", "", Stage.TRIAL),
    "is tried": ("trial", "the trial is running", "dead", Stage.TRIAL),
    "is over": ("failed", "the checker could not finish", "", None),
}
"""Stage, words, worker and queue of checks as version 0.1.0 left them."""


@pytest.fixture(params=DATABASES)
def url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path}/books/jobs.sqlite"
    return fresh_database(request.getfixturevalue("postgres_url"))


def written(url: str, upload: str, more: int = 0) -> dict[str, str]:
    """Write books as version 0.1.0 did, and return the ids of their checks.

    Args:
        url: Of a new database.
        upload: Hash of what all of them check.
        more: Checks that are over besides.
    """
    engine = open_database(url)
    prepare(engine)
    schema = "" if engine.dialect.name == "sqlite" else "dbos."
    with engine.begin() as connection:
        if schema:
            connection.exec_driver_sql("CREATE SCHEMA dbos")
        connection.exec_driver_sql(LIBRARY.format(schema))
    ids = {}
    for number, name in enumerate([*STAGES, *["is over"] * more]):
        stage, words, worker, queue = STAGES[name]
        id = ids[f"{name} {number}"] = secrets.token_urlsafe(16)
        check = {
            "id": id,
            "upload": upload,
            "name": f"{number}.zip",
            "stage": stage,
            "words": words,
            "created": 1e9 + number,
            "worker": worker,
            "turn": number,
        }
        with engine.begin() as connection:
            connection.execute(sa.text(CHECK), check)
            connection.execute(sa.text(EVENT), {"id": id})
            for each in {Stage.STATIC, queue or Stage.STATIC}:
                workflow = id if each is Stage.STATIC else f"{id}.trial"
                told = {"id": workflow, "name": each.value, "status": "ENQUEUED"}
                connection.execute(sa.text(QUEUED.format(schema)), told)
    engine.dispose()
    return ids


def bytes_of(url: str) -> bytes:
    """Return all bytes of a database: its files, or a dump of what a server keeps."""
    if url.startswith("sqlite"):
        place = Path(url.removeprefix("sqlite:///"))
        return b"".join(each.read_bytes() for each in place.parent.iterdir())
    return dump(url)


@pytest.fixture
def upload(tmp_path: Path) -> str:
    with Store(tmp_path / "store").incoming() as incoming:
        incoming.write(b"robot")
        return incoming.finish()


@pytest.fixture
def ids(url: str, upload: str) -> dict[str, str]:
    return written(url, upload)


@pytest.fixture
def site(url: str, ids: dict[str, str], tmp_path: Path) -> Iterator[Site]:
    assert all(id.encode() in bytes_of(url) for id in ids.values())
    site = site_in(tmp_path, url)
    yield site
    site.close()


def test_old_links_lead_to_their_checks(site: Site, ids: dict[str, str]) -> None:
    states = {name: site.state(id) for name, id in ids.items()}
    assert [state.id for state in states.values()] == list(ids.values())
    assert [state.order.name for state in states.values()] == [f"{n}.zip" for n in range(5)]
    assert [state.ahead for state in states.values()] == [0, 1, 0, 1, 0]
    words = ["waiting in the queue"] * 2 + [
        "the trial is waiting in the queue",
        "waiting in the queue",
    ]
    assert [state.words for state in states.values()] == [*words, "the checker could not finish"]
    assert all(site.stages(id) == [(1, "queued")] for id in ids.values())
    assert all(site.jobs.status(key_of_check(id)) is None for id in ids.values())


def test_the_ids_are_gone(site: Site, ids: dict[str, str], url: str) -> None:
    found = bytes_of(url)
    site.close()
    found += bytes_of(url)
    for id in ids.values():
        assert id.encode() not in found
        assert key_of_check(id).encode() in found


def test_checks_that_were_not_over_are_gone_on_with(site: Site, ids: dict[str, str]) -> None:
    site.worker()
    for name, id in ids.items():
        state = site.end(id)
        over = name.startswith("is over")
        assert (state.stage, state.words == WORDS) == (
            (Stage.FAILED, False) if over else (Stage.DONE, True)
        )
    told = [event.words for id in ids.values() for event in site.jobs.events(id)]
    assert not any("starts again" in words for words in told)
    assert set(site.begun().values()) == {1}


def test_many_may_hash_many_checks_at_once(url: str, upload: str, tmp_path: Path) -> None:
    ids = written(url, upload, more=420)
    engines = [open_database(url) for _ in range(4)]
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(prepare, engines))
    for engine in engines:
        engine.dispose()
    jobs = durable_jobs(url, Store(tmp_path / "store"))
    assert all(jobs.status(id) is not None for id in ids.values())
    assert sum(jobs.alive().waiting.values()) == 4
    jobs.engine.dispose()
    assert not any(id.encode() in bytes_of(url) for id in ids.values())


def test_a_file_that_was_not_written_anew_is_at_the_next_start(tmp_path: Path) -> None:
    """As when the process was killed between the change and its end."""
    engine = open_database(f"sqlite:///{tmp_path}/jobs.sqlite")
    prepare(engine)
    with engine.begin() as connection:
        connection.exec_driver_sql("CREATE TABLE left_over (id TEXT)")
        connection.exec_driver_sql("INSERT INTO left_over VALUES ('an id in the clear')")
        connection.exec_driver_sql("PRAGMA user_version=1")
    with engine.connect() as connection:
        connection.exec_driver_sql("PRAGMA secure_delete=OFF")  # on by default in some builds
        connection.exec_driver_sql("DROP TABLE left_over")
    prepare(engine)
    with engine.connect() as connection:
        assert connection.exec_driver_sql("PRAGMA user_version").scalar() == 0
        found = b"".join(each.read_bytes() for each in tmp_path.iterdir())
    assert b"an id in the clear" not in found
    engine.dispose()


def test_columns_of_later_versions_are_added(url: str, upload: str, tmp_path: Path) -> None:
    ids = written(url, upload)
    engine = open_database(url)
    with engine.begin() as connection:
        connection.exec_driver_sql("ALTER TABLE subt_checks DROP COLUMN secret")
    prepare(engine)
    engine.dispose()
    jobs = durable_jobs(url, Store(tmp_path / "store"))
    for id in ids.values():
        assert jobs.status(id) is not None
        assert jobs.cancel(id, "") is False
    new = jobs.submit(Order(upload, "robot.zip"))
    assert jobs.cancel(new.id, new.secret)
    jobs.engine.dispose()
