"""Connections as the web server has them: who stands still, or comes in crowds, is sent away."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field

from uvicorn.protocols.http.h11_impl import H11Protocol

from checker.service.web.rate import network_of


@dataclass
class Deadline:
    """Has something done after a while, unless it is called off before."""

    do: Callable[[], None]
    _timer: asyncio.TimerHandle | None = field(default=None, repr=False)

    def set(self, seconds: float) -> None:
        """Begin to count; nothing happens if it counts already."""
        if self._timer is None:
            self._timer = asyncio.get_running_loop().call_later(seconds, self._reached)

    def call_off(self) -> None:
        """Count no more."""
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None

    def _reached(self) -> None:
        self._timer = None
        self.do()


class Connection(H11Protocol):
    """HTTP/1.1 as the server speaks it, with an end to its patience.

    The server waits for ever for the rest of a request's head, and for a client that does not read
    its answer. As many connections as it takes at once would be enough to shut everybody out.

    Attributes:
        head_seconds: That the head of a request may take.
        reading_seconds: That a client may take nothing of an answer that waits for it. Systems
            buffer hundreds of kilobytes before they ask for more, and modems need as long for them.
        crowd: Connections of one address or IPv6 network; 0 for any number.
        network: Whence it comes, as `checker.service.web.rate.network_of` says it.
    """

    head_seconds = 10.0
    reading_seconds = 120.0
    crowd = 500
    network = ""

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begin to wait for a request."""
        super().connection_made(transport)
        self.network = network_of(self.client[0]) if self.client else ""
        self._head, self._reader = Deadline(self._give_up), Deadline(self._look_at_reader)
        if self.crowd and self._is_one_too_many():
            transport.abort()
        else:
            self._head.set(self.head_seconds)

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait for nothing any more."""
        self._head.call_off()
        self._reader.call_off()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Take what comes; only a whole head ends the wait for it."""
        super().data_received(data)
        if self._answers():
            self._head.call_off()
        elif not self.transport.is_closing():
            self._head.set(self.head_seconds)

    def pause_writing(self) -> None:
        """Begin to wait for the reader."""
        super().pause_writing()
        self._unread = self.transport.get_write_buffer_size()
        self._reader.set(self.reading_seconds)

    def resume_writing(self) -> None:
        """Go on, as the reader has read."""
        super().resume_writing()
        self._reader.call_off()

    def _give_up(self) -> None:
        if not self._answers():
            self.transport.abort()

    def _look_at_reader(self) -> None:
        unread, self._unread = self._unread, self.transport.get_write_buffer_size()
        if self._unread < unread:
            self._reader.set(self.reading_seconds)
        else:
            self.transport.abort()

    def _answers(self) -> bool:
        """Whether a request is being answered."""
        return self.cycle is not None and not self.cycle.response_complete

    def _is_one_too_many(self) -> bool:
        peers = (each for each in self.connections if isinstance(each, Connection))
        return sum(each.network == self.network for each in peers) > self.crowd


class ProxyConnection(Connection):
    """The same from a proxy, which speaks for many."""

    crowd = 0
