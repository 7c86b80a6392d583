"""The body of an answer: none for HEAD requests, gzip for clients that accept it.

No answer that brings a secret is compressed, such as that to an upload: its length would reveal it
(BREACH; docs/security.md).
"""

from __future__ import annotations

import gzip
from functools import partial

from anyio.to_thread import run_sync
from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from checker.base.record import Record

LEAST = 1_000
"""Bytes of an answer that is worth it: less fits into one packet."""
_AT_ONCE = 50_000
"""Bytes that take a millisecond; what is longer is done in a thread."""
_TEXT = ("text/html", "text/css", "text/javascript", "application/json", "image/svg+xml")
_GZIP = {"content-encoding": "gzip"}
VARY = {"vary": "Accept-Encoding"}
_pack = partial(gzip.compress, compresslevel=6, mtime=0)


def takes_gzip(headers: Headers) -> bool:
    """Return whether a client takes compressed answers (RFC 9110, 12.5.3)."""
    for coding in headers.get("accept-encoding", "").lower().split(","):
        name, *weights = (word.strip() for word in coding.split(";"))
        if name == "gzip":
            return not any(each.startswith("q=") and not each[2:].strip("0.") for each in weights)
    return False


class Compression(Record):
    """Compresses complete answers to GET: pages, and answers of the API."""

    app: ASGIApp

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        takes = scope["method"] == "GET" and takes_gzip(Headers(scope=scope))
        start: Message = {}

        async def compressing(message: Message) -> None:
            nonlocal start
            if message["type"] == "http.response.start" and _may_be_compressed(message):
                start = message  # what is in it depends on the body; a stream's would be late
                return
            if start:
                head, start = start, {}
                message = await _compressed(head, message, takes=takes)
                await send(head)
            await send(message)

        await self.app(scope, receive, compressing)


def _may_be_compressed(start: Message) -> bool:
    headers = Headers(raw=start["headers"])
    kind = headers.get("content-type", "").partition(";")[0]
    return kind in _TEXT and "vary" not in headers


async def _compressed(start: Message, message: Message, *, takes: bool) -> Message:
    """Return the body of an answer as it is sent, and state it in its head."""
    headers, body = MutableHeaders(scope=start), message.get("body", b"")
    if message.get("more_body") or len(body) < LEAST:
        return message
    headers.update(VARY)
    if not takes:
        return message
    packed = _pack(body) if len(body) <= _AT_ONCE else await run_sync(_pack, body)
    headers.update({**_GZIP, "content-length": str(len(packed))})
    return {**message, "body": packed}


class Heads(Record):
    """Answers HEAD as GET at every address, without the body (RFC 9110, 9.3.2)."""

    app: ASGIApp

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http" or scope["method"] != "HEAD":
            await self.app(scope, receive, send)
            return

        async def head_alone(message: Message) -> None:
            if message["type"] == "http.response.start":
                await send(message)
                # The answer has ended: stop the sender of a long body.
                await send({"type": "http.response.body"})

        # What routes write into the scope is for those around as well.
        scope["method"] = "GET"
        try:
            await self.app(scope, receive, head_alone)
        finally:
            scope["method"] = "HEAD"
