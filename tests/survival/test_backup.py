"""A copy of the database and of the store, taken while the service runs, is a service as well."""

from __future__ import annotations

import shutil
import sqlite3
import subprocess
import threading
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from urllib.parse import urlsplit

import httpx
import pytest

from checker.service.jobs.port import Receipt
from support.postgres import client_program, fresh_database
from tests.serving.conftest import SECONDS, Serving
from tests.survival.conftest import Home, kill, receipt, wait_for, wait_for_end


def copy_of(database: str, folder: Path, server: Callable[[], str]) -> str:
    """Copy a database that is in use, as docs/service.md says; return the address of the copy."""
    if database.startswith("sqlite"):
        copy = folder / "copy.sqlite"
        with (
            closing(sqlite3.connect(urlsplit(database).path.removeprefix("/"))) as original,
            closing(sqlite3.connect(copy)) as made,
        ):
            original.backup(made)  # what `.backup` does
        return f"sqlite:///{copy}"
    dump, copied = folder / "dump.sql", fresh_database(server())
    subprocess.run([client_program("pg_dump"), "--file", dump, database], check=True)
    restored = [*(client_program("psql"), "--quiet", "--set", "ON_ERROR_STOP=1"), "--file", dump]
    subprocess.run([*restored, copied], check=True, stdout=subprocess.DEVNULL)
    return copied


@contextmanager
def busy(url: str, receipts: list[Receipt]) -> Iterator[None]:
    """Have somebody upload again and again."""
    enough = threading.Event()

    def upload() -> None:
        while not enough.wait(0.1):
            receipts.append(receipt(url))

    thread = threading.Thread(target=upload)
    thread.start()
    try:
        yield
    finally:
        enough.set()
        thread.join(SECONDS)


def copied(home: Home, folder: Path, server: Callable[[], str]) -> Home:
    """Return a copy of what a service keeps: the database first, then what it names."""
    data = folder / "data"
    data.mkdir(parents=True)
    database = copy_of(home.database, folder, server)
    for name in ("uploads", "results"):
        shutil.copytree(home.folder / "data" / name, data / name)
    return Home(home.start, folder, database)


def report(serving: Serving, id: str) -> httpx.Response:
    return httpx.get(f"{serving.url}/api/checks/{id}/report.json", timeout=SECONDS)


def test_a_copy_taken_while_it_runs_is_gone_on_with(
    home: Home, request: pytest.FixtureRequest
) -> None:
    serving = home.serve()
    home.worker()
    done = [receipt(serving.url) for _ in range(2)]
    for each in done:
        wait_for_end(serving.url, each.id)
    begun = [receipt(serving.url) for _ in range(4)]
    wait_for(lambda: sum(home.begun().values()) > 4)
    later: list[Receipt] = []
    with busy(serving.url, later):
        wait_for(lambda: len(later) > 1)
        sent = [*begun, *later]
        copy = copied(
            home, home.folder / "copied", lambda: str(request.getfixturevalue("postgres_url"))
        )
    home.kill_workers()
    kill(serving)
    for name in ("data", "jobs.sqlite"):
        if (home.folder / name).exists():
            (home.folder / name).rename(home.folder / f"lost-{name}")

    restored = copy.serve()
    for each in done:
        assert report(restored, each.id).status_code == 200
    waiting = [each for each in sent if report(restored, each.id).status_code == 404]
    assert waiting, "some had no result yet when the copy was taken"
    copy.worker()
    try:
        for each in sent:
            assert wait_for_end(restored.url, each.id)["stage"] == "done"
            assert report(restored, each.id).status_code == 200
    finally:
        copy.kill_workers()
    deleted = httpx.delete(
        f"{restored.url}/api/checks/{done[0].id}", headers={"Subt-Check-Secret": done[0].secret}
    )
    assert deleted.status_code == 204
