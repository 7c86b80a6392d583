"""The tables of a version before DBOS's: its checks stay, and those not over are gone on with."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
import sqlalchemy as sa

from checker.service.jobs.durable.admin import Admin
from checker.service.jobs.durable.database import open_database
from checker.service.jobs.durable.prepare import prepare_database
from checker.service.jobs.durable.workers import Workers
from checker.service.jobs.port import Receipt, Stage
from support.postgres import DATABASES, fresh_database
from tests.jobs.quick_worker import WORDS
from tests.jobs.site import Site, site_in

STORED = Path(__file__).parent / "stored" / "before_dbos.sql"
"""Written by that version: six checks with the profiles of `quick_worker`, of which two wait."""
RECEIPTS = {
    "done.zip": Receipt("D3LnWKaQet8LeG9Js5q0fD", "-T2ZFQZdZpdqHCD-HOwNqR"),
    "refused.zip": Receipt("kEIlsruwRh0VNzKggykJih", "JfNDNkP8JhafkPcuLRjLv7"),
    "failed.zip": Receipt("WCgevHSPlC9D3SsngjJOLu", "PKvzMwzvbGfks-G_EXbi4K"),
    "cancelled.zip": Receipt("WsuZT8ObejSEpp-ZojQPsi", "jPhCZA7crdkj7Qq3J7_Fyy"),
    "tried.zip": Receipt("AosAusxPGvhoagvmPqYSub", "Ae2vCxzuuLkSZl1PFDboMl"),
    "waits.zip": Receipt("DIBAKSmv4hNqMBmO32AsPf", "Evh-Ro17iUPKKDwOw0chQn"),
}
STAGES = {
    "done.zip": Stage.DONE,
    "refused.zip": Stage.REFUSED,
    "failed.zip": Stage.FAILED,
    "cancelled.zip": Stage.CANCELLED,
    "tried.zip": Stage.QUEUED,
    "waits.zip": Stage.QUEUED,
}


@pytest.fixture(params=DATABASES)
def url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """A database as that version left it."""
    file = tmp_path / "books" / "jobs.sqlite"
    file.parent.mkdir()
    with sqlite3.connect(file) as connection:
        connection.executescript(STORED.read_text())
    stored = f"sqlite:///{file}"
    if request.param == "sqlite":
        return stored
    return copied(stored, fresh_database(request.getfixturevalue("postgres_url")))


def copied(url: str, other: str) -> str:
    """Copy all tables of a database into another one, and return its address."""
    source, target = open_database(url), open_database(other)
    tables = sa.MetaData()
    tables.reflect(source)
    for column in (column for table in tables.sorted_tables for column in table.columns):
        column.type = column.type.as_generic()
    tables.create_all(target)
    with source.connect() as from_there, target.begin() as into:
        for table in tables.sorted_tables:
            into.execute(sa.insert(table), [*from_there.execute(sa.select(table)).mappings()])
    source.dispose()
    target.dispose()
    return other


@pytest.fixture
def site(url: str, tmp_path: Path) -> Iterator[Site]:
    site = site_in(tmp_path, url)
    yield site
    site.close()


def test_links_lead_to_their_checks(site: Site) -> None:
    states = {name: site.state(receipt.id) for name, receipt in RECEIPTS.items()}
    assert {name: state.stage for name, state in states.items()} == STAGES
    assert [state.order.name for state in states.values()] == [*RECEIPTS]
    assert states["done.zip"].words == WORDS
    assert [package["name"] for package in states["done.zip"].packages] == ["quick"]
    assert states["done.zip"].created == pytest.approx(1795808004.9, abs=0.1)
    assert states["done.zip"].result


def test_checks_that_were_not_over_are_gone_on_with(site: Site) -> None:
    site.worker()
    # Its trial takes a minute, and may begin before that of the other one.
    tried = site.in_hand(RECEIPTS["tried.zip"].id, Stage.TRIAL)
    assert tried.result
    assert site.jobs.cancel(*_of("tried.zip"))
    assert site.end(tried.id).stage is Stage.CANCELLED
    assert site.end(RECEIPTS["waits.zip"].id).stage is Stage.DONE


def test_their_senders_can_delete_them(site: Site) -> None:
    for name, receipt in RECEIPTS.items():
        assert site.jobs.delete(receipt.id, "s" * 22) is False
        assert site.jobs.delete(*_of(name))
        assert site.jobs.status(receipt.id) is None


def test_many_may_take_them_over_at_once(url: str) -> None:
    engines = [open_database(url) for _ in range(4)]
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(prepare_database, engines))
    assert found[0].waiting() == {"static": 2, "trial": 0, "": 0}
    assert not sa.inspect(engines[0]).has_table("subt_checks")
    for engine in engines:
        engine.dispose()


def _of(name: str) -> tuple[str, str]:
    return RECEIPTS[name].id, RECEIPTS[name].secret


def test_one_that_had_failed_can_be_begun_anew(site: Site) -> None:
    admin = Admin(site.jobs.checks, Workers(site.jobs.checks.engine))
    [key] = admin.keys_of([RECEIPTS["failed.zip"].id], over=True)
    admin.requeue(key)
    assert site.state(RECEIPTS["failed.zip"].id).stage is Stage.STATIC
    assert [each.key for each in admin.list_checks() if each.number == 2] == [key]
