"""Refused uploads are read on for a moment, so that the refusal arrives.

A server that closes a connection with unread bytes has the system reset it, and the client loses
the answer that says why.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from time import monotonic

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from checker.base.record import Record

LINGER_SECONDS = 10.0
PAUSE_SECONDS = 1.0
"""A client that sends nothing for so long has read the answer, or never will."""


@dataclass
class _Body:
    """The body of a request; `read` says whether all of it has come."""

    receive: Receive
    read: bool = False

    async def __call__(self) -> Message:
        message = await self.receive()
        ended = message["type"] == "http.request" and not message.get("more_body", False)
        self.read = self.read or ended or message["type"] == "http.disconnect"
        return message

    async def drain(self) -> None:
        """Read on and throw away."""
        deadline = monotonic() + LINGER_SECONDS
        while not self.read and monotonic() < deadline:
            try:
                async with asyncio.timeout(PAUSE_SECONDS):
                    await self()
            except TimeoutError:
                return


class Courtesy(Record):
    """Ends an answer only after the request has been read, within limits."""

    app: ASGIApp

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http" or scope["method"] in ("GET", "HEAD"):
            await self.app(scope, receive, send)
            return
        body = _Body(receive, read=not _has_body(Headers(scope=scope)))

        async def last_after_reading(message: Message) -> None:
            if message["type"] == "http.response.start" and not body.read:
                MutableHeaders(scope=message)["connection"] = "close"
            if message["type"] != "http.response.body" or message.get("more_body") or body.read:
                await send(message)
                return
            await send({**message, "more_body": True})
            await body.drain()
            await send({"type": "http.response.body"})

        await self.app(scope, body, last_after_reading)


def _has_body(headers: Headers) -> bool:
    return "transfer-encoding" in headers or headers.get("content-length", "0") != "0"
