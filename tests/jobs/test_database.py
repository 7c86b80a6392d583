"""Addresses, first starts at the same moment, and databases that do not answer."""

from __future__ import annotations

import socket
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from threading import Barrier
from time import monotonic, sleep, time

import pytest
import sqlalchemy as sa

from bench.chaos import server_process, standing_still
from checker.base.errors import CheckerError
from checker.service.jobs.durable.client import durable_jobs
from checker.service.jobs.durable.database import database_url, open_database
from checker.service.jobs.durable.prepare import prepare_database
from checker.service.jobs.durable.workers import Workers, now
from checker.service.jobs.port import JobsUnreachable, Order, Stage
from checker.service.store.store import Store
from support.postgres import DATABASES, fresh_database
from tests.jobs.site import Site, site_in


@pytest.fixture(params=DATABASES)
def url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path}/jobs.sqlite"
    return fresh_database(request.getfixturevalue("postgres_url"))


def test_many_may_prepare_a_new_database_at_once(url: str) -> None:
    engines = [open_database(url) for _ in range(4)]
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(prepare_database, engines))
    with engines[0].connect() as connection:
        names = sa.inspect(connection).get_table_names()
    assert {"subt_salts", "subt_workers"} <= set(names)
    for engine in engines:
        engine.dispose()


def test_many_may_open_a_new_file_at_once(tmp_path: Path) -> None:
    together = Barrier(6)

    def opened(url: str) -> None:
        engine = open_database(url)
        together.wait()
        with engine.connect() as connection:
            connection.execute(sa.text("CREATE TABLE IF NOT EXISTS names (name)"))
        engine.dispose()

    with ThreadPoolExecutor(6) as pool:
        for number in range(60):
            list(pool.map(opened, 6 * [f"sqlite:///{tmp_path}/{number}.sqlite"]))


def test_its_clock_is_about_right(url: str) -> None:
    engine = open_database(url)
    with engine.connect() as connection:
        said = connection.execute(sa.select(now(engine))).scalar_one()
    assert said == pytest.approx(time(), abs=60)
    engine.dispose()


def test_it_knows_who_lives(url: str) -> None:
    engine = open_database(url)
    prepare_database(engine)
    workers = Workers(engine)
    for name in ("one", "two", "one"):
        workers.record_heartbeat(name)
    assert workers.live_workers(60.0) == {"one", "two"}
    assert workers.live_workers(-1.0) == set()
    workers.strike("one")
    assert workers.live_workers(60.0) == {"two"}
    workers.strike_silent(60.0)
    assert workers.live_workers(60.0) == {"two"}
    workers.strike_silent(-1.0)
    assert workers.live_workers(60.0) == set()
    engine.dispose()


@pytest.mark.parametrize(
    "address",
    ["", "nonsense", "mysql://u:secret@host/db", "http://[::1", "sqlite://", "sqlite:///:memory:"],
)
def test_an_address_that_is_none_is_not_repeated(address: str) -> None:
    with pytest.raises(CheckerError) as caught:
        open_database(address)
    assert "secret" not in str(caught.value)
    assert "expected sqlite:///" in str(caught.value)


@pytest.mark.service
def test_a_server_that_is_not_there_is_unreachable(tmp_path: Path) -> None:
    with socket.socket() as nobody:
        nobody.bind(("127.0.0.1", 0))
        url = f"postgresql://me:secret@127.0.0.1:{nobody.getsockname()[1]}/jobs"
        with pytest.raises(JobsUnreachable) as caught:
            durable_jobs(url, Store(tmp_path))
    assert "Connection refused" in str(caught.value)
    assert "secret" not in str(caught.value)


def test_a_file_that_is_no_database_cannot_be_read(tmp_path: Path) -> None:
    file = tmp_path / "jobs.sqlite"
    file.write_bytes(b"a page of the service" * 999)
    with pytest.raises(JobsUnreachable, match=r"cannot be read: file is not a database"):
        durable_jobs(f"sqlite:///{file}", Store(tmp_path))


def test_a_database_that_is_a_folder_cannot_be_written(tmp_path: Path) -> None:
    with pytest.raises(JobsUnreachable, match=r"cannot be written \(Is a directory\)"):
        open_database(f"sqlite:///{tmp_path}")


def test_only_its_owner_can_read_it(tmp_path: Path) -> None:
    engine = open_database(f"sqlite:///{tmp_path}/jobs.sqlite")
    prepare_database(engine)
    # Beside it lie what is written ahead and its index, as long as it is open.
    with engine.connect():
        found = {each.name: each.stat().st_mode & 0o777 for each in tmp_path.iterdir()}
    assert found == dict.fromkeys(("jobs.sqlite", "jobs.sqlite-wal", "jobs.sqlite-shm"), 0o600)
    engine.dispose()


def test_one_that_others_could_read_is_tightened(tmp_path: Path) -> None:
    url = f"sqlite:///{tmp_path}/jobs.sqlite"
    first = open_database(url)
    prepare_database(first)
    with first.connect():
        for each in tmp_path.iterdir():
            each.chmod(0o666)
        second = open_database(url)
        found = {each.name: each.stat().st_mode & 0o777 for each in tmp_path.iterdir()}
        assert found == dict.fromkeys(("jobs.sqlite", "jobs.sqlite-wal", "jobs.sqlite-shm"), 0o600)
    first.dispose()
    second.dispose()


def test_a_database_that_goes_away_is_unreachable_in_every_call(tmp_path: Path) -> None:
    place = tmp_path / "data"
    jobs = durable_jobs(f"sqlite:///{place}/jobs.sqlite", Store(tmp_path))
    id = jobs.submit(Order("0" * 64, "robot.zip")).id
    jobs.checks.engine.dispose()
    place.rename(tmp_path / "gone")
    for call in (
        lambda: jobs.submit(Order("0" * 64, "robot.zip")),
        lambda: jobs.status(id),
        lambda: jobs.events({id: 0}),
        lambda: jobs.cancel(id, ""),
        lambda: jobs.delete(id, ""),
        jobs.alive,
    ):
        with pytest.raises(JobsUnreachable):
            call()
    (tmp_path / "gone").rename(place)
    state = jobs.status(id)
    assert state is not None
    assert state.stage is Stage.QUEUED
    jobs.checks.engine.dispose()


@pytest.fixture
def site(tmp_path: Path, postgres_url: str) -> Site:
    return site_in(tmp_path, fresh_database(postgres_url))


def test_connections_that_break_do_not_break_a_check(site: Site) -> None:
    site.worker()
    id = site.submit("trial:2")
    name = site.in_hand(id, Stage.TRIAL).order.name
    cut = sa.text(
        "SELECT count(pg_terminate_backend(pid)) FROM pg_stat_activity "
        "WHERE datname = current_database() AND pid <> pg_backend_pid()"
    )
    with site.jobs.checks.engine.connect() as connection:
        assert connection.execute(cut).scalar_one() > 0
    assert site.end(id).stage is Stage.DONE
    assert site.begun()[f"trial {name}"] == 1
    site.close()


def test_one_that_stands_still_is_unreachable_within_seconds(site: Site, postgres_url: str) -> None:
    id = site.submit()
    with standing_still(server_process(postgres_url)), ThreadPoolExecutor(60) as pool:
        began = monotonic()
        asked = [pool.submit(site.jobs.status, id) for _ in range(60)]
        for each in asked:
            with pytest.raises(JobsUnreachable):
                each.result()
        assert monotonic() - began < 20.0
        began = monotonic()
        with pytest.raises(JobsUnreachable):
            site.jobs.status(id)
        assert monotonic() - began < 1.0
    for _ in range(100):
        with suppress(JobsUnreachable):
            assert site.state(id).stage is Stage.QUEUED
            break
        sleep(0.2)
    else:
        pytest.fail("the database answers, and nobody sees it")
    site.close()


def test_the_address_is_of_a_file_with_the_data_unless_told_otherwise(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    data = tmp_path / "a?b c%20"
    monkeypatch.setenv("SUBT_CHECK_DATA", str(data))
    monkeypatch.delenv("SUBT_CHECK_DATABASE_URL", raising=False)
    engine = open_database(database_url())
    with engine.connect():
        assert (data / "jobs.sqlite").is_file()
    engine.dispose()
    monkeypatch.setenv("SUBT_CHECK_DATABASE_URL", "postgresql://elsewhere/jobs")
    assert database_url() == "postgresql://elsewhere/jobs"
