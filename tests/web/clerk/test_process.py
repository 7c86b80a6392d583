"""A clerk in a process of its own: what it takes is kept and ordered, whatever becomes of it."""

from __future__ import annotations

import asyncio
import os
import signal
import sys
import zipfile
from collections.abc import Coroutine, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from time import monotonic
from typing import Any, TypeVar

import pytest
from blake3 import blake3

from checker.service.jobs.durable.client import durable_jobs
from checker.service.jobs.place import database_url
from checker.service.jobs.port import JobsUnreachable, Stage
from checker.service.processes.child import CHILD
from checker.service.store.store import Store
from checker.service.web.clerk.port import Slip
from checker.service.web.clerk.process import ProcessClerk
from checker.service.web.clerk.wire import ClerkFailed
from checker.service.web.refusal import Refused
from tests.web.server import left_behind

T = TypeVar("T")


@pytest.fixture
def store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Store:
    monkeypatch.setenv("SUBT_CHECK_DATA", str(tmp_path / "data"))
    return Store(tmp_path / "data")


@pytest.fixture
def clerk() -> Iterator[ProcessClerk]:
    clerk = ProcessClerk((*CHILD, str(os.getpid()), "clerk"))
    yield clerk
    assert clerk.pid is None, "each test stops it in its loop"


def run(clerk: ProcessClerk, work: Coroutine[Any, Any, T]) -> T:
    """Run work in an event loop, and stop the clerk in it.

    In a thread of its own: a browser of other tests may have a loop in this one.
    """

    async def all_of_it() -> T:
        try:
            return await work
        finally:
            clerk.stop()

    with ThreadPoolExecutor(1) as threads:
        return threads.submit(asyncio.run, all_of_it()).result()


async def taken(clerk: ProcessClerk, store: Store, content: bytes, name: str = "a.sdf") -> str:
    with store.incoming() as incoming:
        incoming.write(content)
        return await clerk.take(Slip(str(incoming.path), name, "sdf"))


def test_what_it_takes_is_kept_and_ordered(store: Store, clerk: ProcessClerk) -> None:
    async def work() -> list[str]:
        contents = [b"<sdf/>%d" % number for number in range(30)]
        return await asyncio.gather(*(taken(clerk, store, each) for each in contents))

    ids = run(clerk, work())
    assert len(set(ids)) == 30
    jobs = durable_jobs(database_url(), store)
    for number, id in enumerate(ids):
        state = jobs.status(id)
        assert state is not None
        assert (state.stage, state.order.name, state.order.profile) == (
            Stage.QUEUED,
            "a.sdf",
            "sdf",
        )
        assert state.order.upload == blake3(b"<sdf/>%d" % number).hexdigest()
        assert store.upload(state.order.upload) is not None
    assert not list((store.folder / "incoming").iterdir())


def test_an_archive_that_may_do_harm_is_refused(store: Store, clerk: ProcessClerk) -> None:
    bad = store.folder.parent / "bad.zip"
    with zipfile.ZipFile(bad, "w") as archive:
        archive.writestr("../../etc/cron.d/x", "x")
    with pytest.raises(Refused) as refused:
        run(clerk, taken(clerk, store, bad.read_bytes(), "bad.zip"))
    assert refused.value.status == 422
    assert "leads out of the archive" in refused.value.error
    assert not [path for path in left_behind(store) if path.parent.name != "data"]


def test_a_database_that_is_away_is_said(
    store: Store, clerk: ProcessClerk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SUBT_CHECK_DATABASE_URL", "postgresql://127.0.0.1:9/none")
    with pytest.raises(JobsUnreachable):
        run(clerk, taken(clerk, store, b"<sdf/>"))


def test_one_that_hangs_is_replaced(store: Store, clerk: ProcessClerk) -> None:
    async def work() -> None:
        await taken(clerk, store, b"<sdf/>")
        pid = clerk.pid
        assert pid is not None
        clerk.patience = 0.2
        os.kill(pid, signal.SIGSTOP)
        with pytest.raises(Refused) as refused:
            await taken(clerk, store, b"<sdf />")
        assert refused.value.status == 503
        assert refused.value.error == "The service did not take the upload in time."
        assert clerk.pid is None
        clerk.patience = 60
        await taken(clerk, store, b"<sdf  />")
        assert not list((store.folder / "incoming").iterdir())

    run(clerk, work())


def test_many_who_wait_for_one_that_hangs_do_not_stop_the_others() -> None:
    clerk = ProcessClerk(("/bin/sh", "-c", "exec sleep 60"), patience=0.5)

    async def work() -> list[BaseException | str]:
        slips = (clerk.take(Slip("/" + "a" * 300, "a.sdf", "sdf")) for _ in range(1000))
        return await asyncio.gather(*slips, return_exceptions=True)

    began = monotonic()
    assert {type(each) for each in run(clerk, work())} == {Refused}
    assert monotonic() - began < 30


_ANSWERS_SOME = """
import json, socket, sys
with socket.socket(fileno=int(sys.argv[1])) as wire, wire.makefile("rb") as lines:
    for line in lines:
        number, slip = json.loads(line)
        if slip["name"] != "bad":
            wire.sendall(json.dumps([number, {"id": slip["name"]}]).encode() + b"\\n")
"""


def test_one_that_answers_others_is_kept() -> None:
    clerk = ProcessClerk((sys.executable, "-c", _ANSWERS_SOME), patience=60)

    async def work() -> None:
        assert await clerk.take(Slip("/a", "first", "")) == "first"
        pid, clerk.patience = clerk.pid, 1.0
        bad = asyncio.ensure_future(clerk.take(Slip("/a", "bad", "")))
        await asyncio.sleep(0.2)
        clerk.patience = 60
        assert await clerk.take(Slip("/a", "good", "")) == "good"
        with pytest.raises(Refused, match="in time"):
            await bad
        assert clerk.pid == pid

    run(clerk, work())


def test_an_upload_that_is_gone_and_a_fault_of_ours_end_no_clerk(
    store: Store, clerk: ProcessClerk
) -> None:
    async def work() -> str:
        clerk.start()
        first = clerk.pid
        with pytest.raises(OSError, match="No such file"):
            await clerk.take(Slip("/nowhere/a.part", "a.sdf", ""))
        with pytest.raises(ClerkFailed):
            await clerk.take(Slip("", None, ""))  # type: ignore[arg-type]
        id = await taken(clerk, store, b"<sdf/>")
        assert clerk.pid == first
        return id

    assert run(clerk, work())


def test_one_that_dies_is_replaced_and_who_waited_is_told(
    store: Store, clerk: ProcessClerk
) -> None:
    async def work() -> str:
        await taken(clerk, store, b"<sdf/>")
        assert clerk.pid is not None
        os.kill(clerk.pid, signal.SIGSTOP)
        waiting = asyncio.ensure_future(taken(clerk, store, b"<sdf>1</sdf>"))
        await asyncio.sleep(0.1)
        assert not waiting.done()
        os.kill(clerk.pid, signal.SIGKILL)
        with pytest.raises(Refused) as refused:
            await waiting
        assert refused.value.status == 503
        assert int(refused.value.headers["Retry-After"]) > 0
        return await taken(clerk, store, b"<sdf>1</sdf>")

    assert run(clerk, work())
    assert not list((store.folder / "incoming").iterdir())


def test_who_leaves_while_it_works_harms_nobody(store: Store, clerk: ProcessClerk) -> None:
    async def work() -> str:
        clerk.start()
        leaving = asyncio.ensure_future(taken(clerk, store, b"<sdf/>"))
        await asyncio.sleep(0)
        leaving.cancel()
        return await taken(clerk, store, b"<sdf>1</sdf>")

    assert run(clerk, work())
