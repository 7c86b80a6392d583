"""Checks that stand where a test puts them, as on a board, and results that it makes up."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import httpx
from msgspec.structs import replace

from checker.service.jobs.port import Alive, Event, Order, Receipt, Stage, State
from checker.service.store.store import Store

if TYPE_CHECKING:
    from fastapi import FastAPI

KEY = "a" * 64
ID = "0123456789abcdefghijkl"
SECRET = "only-the-sender-has-it"  # noqa: S105
SENDER = {"Subt-Check-Secret": SECRET, "Cookie": f"subt-check-secret={SECRET}"}
"""What a program and a browser send of a check that they have ordered."""
COUNTS = {"errors": 5, "warnings": 1, "infos": 0}
ROVER = {"name": "rover", "verdict": "not_ready", "folder": "", **COUNTS}
QUEUED = State(ID, Order("b" * 64, "rover.zip"), Stage.QUEUED, expires=2e9)
WORDS = "Not ready: 5 errors to fix"
DONE = replace(QUEUED, stage=Stage.DONE, result=KEY, packages=(ROVER,), words=WORDS)


@dataclass
class BoardJobs:
    """Checks that stand where a test puts them."""

    states: dict[str, State] = field(default_factory=dict)
    cancelled: list[str] = field(default_factory=list)
    keys: list[str] = field(default_factory=list)
    taken: Mapping[str, float] = field(default_factory=dict)
    waits: Mapping[tuple[str, int], float] = field(default_factory=dict)

    def submit(self, order: Order, key: str = "") -> Receipt:
        self.keys.append(key)
        self.states[ID] = replace(QUEUED, order=order)
        return Receipt(ID, SECRET)

    def status(self, id: str) -> State | None:
        return self.states.get(id)

    def events(self, after: Mapping[str, int]) -> Mapping[str, Sequence[Event]]:
        return {
            id: [event for event in self.happened() if event.number > number]
            for id, number in after.items()
            if id in self.states
        }

    def happened(self) -> Sequence[Event]:
        stages = (Stage.QUEUED, Stage.STATIC)
        return [Event(n, stage, "", 0.0) for n, stage in enumerate(stages, 1)]

    def cancel(self, id: str, secret: str) -> bool:
        if secret == SECRET:
            self.cancelled.append(id)
        return secret == SECRET

    def delete(self, id: str, secret: str) -> bool:
        if secret == SECRET:
            del self.states[id]
        return secret == SECRET

    def wait(self, client: str, per_minute: int) -> float:
        return self.waits.get((client, per_minute), 0.0)

    def stage_seconds(self) -> Mapping[str, float]:
        return self.taken

    def alive(self) -> Alive:
        return Alive({"one": 0.0}, {}, 0)


def keep_result(store: Store, report: str, *names: str, key: str = KEY) -> None:
    with store.workplace() as place:
        for name in ("report.json", *names):
            (place / "made" / name).parent.mkdir(parents=True, exist_ok=True)
            (place / "made" / name).write_text(report, "utf-8")
        store.keep(key, place / "made")


@dataclass
class Client:
    """Asks an application, one request after the other, and follows no redirects."""

    app: FastAPI

    def get(self, address: str) -> httpx.Response:
        return self.request("GET", address)

    def post(self, address: str, **given: Any) -> httpx.Response:
        return self.request("POST", address, **given)

    def request(self, method: str, address: str, **given: Any) -> httpx.Response:
        async def ask() -> httpx.Response:
            transport = httpx.ASGITransport(self.app)
            async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as http:
                return await http.request(method, address, **given)

        # In a thread of its own: a browser that runs has this one's event loop.
        with ThreadPoolExecutor(1) as thread:
            return thread.submit(asyncio.run, ask()).result()
