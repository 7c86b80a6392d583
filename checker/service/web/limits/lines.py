"""Queues for long work: clients with much of it wait in separate queues."""

from __future__ import annotations

import asyncio
from collections import Counter, OrderedDict, deque
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager


class Lines:
    """Gives places to the first of each line in turn; used by one event loop alone."""

    def __init__(self, places: int, per_sender: int) -> None:
        """Begin with all places free.

        Args:
            places: The places of all senders.
            per_sender: The number for one sender.
        """
        self._free, self._per_sender = places, per_sender
        self._taken: Counter[str] = Counter()
        self._lines: OrderedDict[str, deque[asyncio.Future[None]]] = OrderedDict()

    @asynccontextmanager
    async def place(self, sender: str) -> AsyncIterator[None]:
        """Wait for a place, and hold it."""
        turn = asyncio.get_running_loop().create_future()
        self._lines.setdefault(sender, deque()).append(turn)
        self._call()
        try:
            await turn
            yield
        finally:
            # One that was called off has no place; it is ignored when its turn comes.
            if not turn.cancelled():
                self._give_back(sender)

    def _call(self) -> None:
        """Admit those that may come next, one of each line after the other."""
        while self._free and (sender := self._next()) is not None:
            turn = self._lines[sender].popleft()
            self._lines.move_to_end(sender)
            if not self._lines[sender]:
                del self._lines[sender]
            if not turn.cancelled():
                self._free -= 1
                self._taken[sender] += 1
                turn.set_result(None)

    def _next(self) -> str | None:
        may = (each for each in self._lines if self._taken[each] < self._per_sender)
        return next(may, None)

    def _give_back(self, sender: str) -> None:
        self._free += 1
        self._taken[sender] -= 1
        if not self._taken[sender]:
            del self._taken[sender]
        self._call()
