"""Uploads that come at once are read one after the other, as far as their senders keep up.

Read side by side, all of them would be whole at the end, and until then there would be nothing that
the clerk could do.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

_AT_A_TIME = 2
"""Uploads: one is read while the next piece of the other is on its way."""
_SECONDS = 0.05
"""Of a turn; a megabyte from a client that keeps up takes a tenth of it."""


class Turns:
    """Gives turns in the order in which they are wanted; used by the event loop alone."""

    def __init__(self) -> None:
        self._free = asyncio.Semaphore(_AT_A_TIME)

    @asynccontextmanager
    async def one(self) -> AsyncIterator[Turn]:
        """Wait for a turn, and have it until it ends, at the latest with this block."""
        await self._free.acquire()
        turn = Turn(self._free)
        try:
            yield turn
        finally:
            turn.end()


class Turn:
    """Says until when an upload may be read before others.

    Attributes:
        until: When that ends, by the clock of the event loop.
        lasts: Whether it has not been ended yet.
    """

    def __init__(self, free: asyncio.Semaphore) -> None:
        self._free = free
        self.until = asyncio.get_running_loop().time() + _SECONDS
        self.lasts = True

    def end(self) -> None:
        """Let others have their turn."""
        if self.lasts:
            self.lasts = False
            self._free.release()
