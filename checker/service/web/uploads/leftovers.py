"""Work in progress whose owners were killed: the web process removes it while it runs."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from typing import TYPE_CHECKING

from starlette.concurrency import run_in_threadpool

from checker.service.logs import LOGGER
from checker.service.store.store import Store

if TYPE_CHECKING:
    from fastapi import FastAPI

SECONDS = 30.0
"""Pause between two rounds; one takes a millisecond where a hundred uploads are under way."""
_LOG = logging.getLogger(LOGGER)


def sweep_while_serving(store: Store) -> Callable[[FastAPI], AbstractAsyncContextManager[None]]:
    """Return the task that runs with an application as long as it serves.

    Args:
        store: The store whose work in progress is searched, that of workers included.
    """

    @asynccontextmanager
    async def while_serving(_: FastAPI) -> AsyncIterator[None]:
        looking = asyncio.create_task(_sweep_again(store))
        try:
            yield
        finally:
            looking.cancel()

    return while_serving


async def _sweep_again(store: Store) -> None:
    while True:
        await asyncio.sleep(SECONDS)
        try:
            await run_in_threadpool(store.sweep)
        except OSError:
            _LOG.exception("what is left of killed processes cannot be removed")
