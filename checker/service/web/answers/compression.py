"""Answers in fewer bytes: gzip, for clients that take it.

Nothing in an answer is secret from who may ask for it, and nobody can make a browser ask for more
than it shows: what lengths of compressed answers tell (BREACH) is in docs/security.md.
"""

from __future__ import annotations

import gzip
import os
from collections import OrderedDict
from functools import partial
from pathlib import Path
from threading import Lock
from typing import BinaryIO

from anyio.to_thread import run_sync
from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from checker.base.record import Record

LEAST = 1_000
"""Bytes of an answer that is worth it: less fits into one packet."""
LARGEST = 32_000_000
"""Bytes of a file that is compressed; a larger one would take seconds."""
ROOM = 64_000_000
"""Bytes of memory for compressed files."""
GAIN = 0.9
"""Of its bytes: a file that stays larger is sent as it is, as one of pictures."""
_AT_ONCE = 50_000
"""Bytes that take a millisecond; what is longer is done in a thread."""
_TEXT = ("text/html", "text/css", "text/javascript", "application/json", "image/svg+xml")
_GZIP = {"content-encoding": "gzip"}
VARY = {"vary": "Accept-Encoding"}
_pack = partial(gzip.compress, compresslevel=6, mtime=0)


def takes_gzip(headers: Headers) -> bool:
    """Whether a client takes compressed answers (RFC 9110, 12.5.3)."""
    for coding in headers.get("accept-encoding", "").lower().split(","):
        name, *weights = (word.strip() for word in coding.split(";"))
        if name == "gzip":
            return not any(each.startswith("q=") and not each[2:].strip("0.") for each in weights)
    return False


class Compression(Record):
    """Compresses answers that come whole: pages, and what the API tells."""

    app: ASGIApp

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        takes = takes_gzip(Headers(scope=scope))
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
    """Return the body of an answer as it is sent, and say so in its head."""
    headers, body = MutableHeaders(scope=start), message.get("body", b"")
    if message.get("more_body") or len(body) < LEAST:
        return message
    headers.update(VARY)
    if not takes:
        return message
    packed = _pack(body) if len(body) <= _AT_ONCE else await run_sync(_pack, body)
    headers.update({**_GZIP, "content-length": str(len(packed))})
    return {**message, "body": packed}


class CompressedFiles:
    """Files of results, compressed once; those that were asked for last are kept."""

    def __init__(self, room: int = ROOM) -> None:
        self._left = room
        self._kept: OrderedDict[tuple[object, ...], bytes] = OrderedDict()
        self._keeping, self._packing = Lock(), Lock()

    def of(self, path: Path, file: BinaryIO, begin: bytes = b"", kind: str = "") -> bytes:
        """Return a file compressed; empty if that is not worth it, or not to be had at once.

        Args:
            path: Of the file.
            file: The same, open; it is where the rest begins, before and after.
            begin: What stands before the rest.
            kind: Tells one beginning from others of the same file.
        """
        status, at = os.fstat(file.fileno()), file.tell()
        key = (path, kind, status.st_ino, status.st_mtime_ns, status.st_size)
        with self._keeping:
            if key in self._kept:
                self._kept.move_to_end(key)
                return self._kept[key]
        # One at a time, and nobody waits: the file as it is serves as well.
        if status.st_size > LARGEST or not self._packing.acquire(blocking=False):
            return b""
        try:
            packed = _pack(begin + file.read())
        finally:
            self._packing.release()
        file.seek(at)
        return self._keep(key, packed if len(packed) < GAIN * status.st_size else b"")

    def _keep(self, key: tuple[object, ...], packed: bytes) -> bytes:
        with self._keeping:
            if key not in self._kept:
                self._kept[key] = packed
                self._left -= len(packed)
            while self._left < 0:
                _, oldest = self._kept.popitem(last=False)
                self._left += len(oldest)
        return packed
