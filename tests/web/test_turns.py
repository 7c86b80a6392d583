"""Turns of uploads: few at a time, in order, and nobody who is slow keeps others waiting."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import Coroutine
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from threading import Event, Thread
from time import monotonic, sleep
from typing import Any

import httpx
import pytest

from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from checker.service.web.turns import Turns
from tests.web.board import BoardJobs
from tests.web.server import BOUNDARY, eventually, form, request_head, served

MODEL = b"<sdf version='1.6'/>"


def run(work: Coroutine[Any, Any, None]) -> None:
    """In a thread of its own: a browser that runs has this one's event loop."""
    with ThreadPoolExecutor(1) as thread:
        thread.submit(asyncio.run, work).result()


def test_few_at_a_time_and_in_order() -> None:
    begun: list[int] = []
    now: set[int] = set()
    most = 0

    async def upload(turns: Turns, number: int) -> None:
        nonlocal most
        async with turns.one():
            begun.append(number)
            now.add(number)
            most = max(most, len(now))
            await asyncio.sleep(0.001)
            now.discard(number)

    async def work() -> None:
        turns = Turns()
        await asyncio.gather(*(upload(turns, number) for number in range(20)))

    run(work())
    assert begun == list(range(20))
    assert most == 2


def test_a_turn_ends_once_however_it_ends() -> None:
    async def leave(turns: Turns) -> None:
        async with turns.one() as turn:
            turn.end()
            turn.end()
            raise ConnectionResetError

    async def upload(turns: Turns, inside: list[int]) -> None:
        async with turns.one():
            inside.append(1)
            await asyncio.sleep(60)

    async def work() -> None:
        turns = Turns()
        for _ in range(5):
            with pytest.raises(ConnectionResetError):
                await leave(turns)
        inside: list[int] = []
        waiting = [asyncio.create_task(upload(turns, inside)) for _ in range(5)]
        await asyncio.sleep(0.05)
        assert len(inside) == 2
        for each in waiting:  # those that wait as well as those that are inside
            each.cancel()
        await asyncio.gather(*waiting, return_exceptions=True)
        async with turns.one(), turns.one():
            pass

    run(work())


def trickle(port: int, length: int, stop: Event) -> None:
    """Send an upload that never stands still and never ends."""
    with socket.create_connection(("127.0.0.1", port)) as connection:
        connection.sendall(request_head(length) + form("slow.sdf", MODEL)[:200])
        while not stop.is_set():
            connection.sendall(b" " * 100)
            sleep(0.004)


def test_slow_senders_keep_nobody_waiting(tmp_path: Path) -> None:
    store, stop = Store(tmp_path / "data"), Event()
    with served(create_app(BoardJobs(), store, Config())) as port, ExitStack() as stack:
        stack.callback(stop.set)
        for _ in range(10):
            Thread(target=trickle, args=(port, 10_000_000, stop), daemon=True).start()
        assert eventually(lambda: len([*store.folder.glob("incoming/*")]) == 10)
        begun = monotonic()
        answer = httpx.post(
            f"http://localhost:{port}/api/checks",
            content=form("quick.sdf", MODEL),
            headers={"Content-Type": f"multipart/form-data; boundary={BOUNDARY}"},
            timeout=30,
        )
        assert answer.status_code == 201
        # Theirs would have lasted for minutes; this is for a machine that does much else.
        assert monotonic() - begun < 15
        assert len([*store.folder.glob("incoming/*")]) >= 10
