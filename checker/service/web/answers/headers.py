"""Headers of every answer, and of every file of a result: browsers load nothing else."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import Response, StreamingResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from checker.base.record import Record
from checker.service.store.packed import SUFFIX
from checker.service.web.answers.bodies import takes_gzip

POLICY = "content-security-policy"
NOTHING = "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
"""The policy for files that are not pages: a browser that shows one runs nothing of it."""
PAGE = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; form-action 'self'; base-uri 'none'; frame-ancestors 'none'"
)
"""For the site's own pages, which contain no script and no style."""
_ALWAYS = {
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "no-referrer",
    "x-robots-tag": "noindex, nofollow",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(), geolocation=(), microphone=(), payment=(), usb=()",
}
_PRIVATE = "private, no-store"
_HTTPS_SECONDS = 31_536_000


class SecurityHeaders(Record):
    """Adds the headers to each answer; a policy or rule for caches that a route gives stays."""

    app: ASGIApp

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                _add(MutableHeaders(scope=message), secure=scope.get("scheme") == "https")
            await send(message)

        await self.app(scope, receive, with_headers)


def _add(headers: MutableHeaders, *, secure: bool) -> None:
    for name, value in _ALWAYS.items():
        headers[name] = value
    is_page = headers.get("content-type", "").startswith("text/html")
    headers.setdefault(POLICY, PAGE if is_page else NOTHING)
    headers.setdefault("cache-control", _PRIVATE)
    if secure:
        headers["strict-transport-security"] = f"max-age={_HTTPS_SECONDS}"


# The files of a result, each with a policy that lets it do nothing else.


KINDS = {
    "report.json": "application/json",
    "report.sarif": "application/sarif+json",
    "report.html": "text/html; charset=utf-8",
    "index.html": "text/html; charset=utf-8",
    "robot.glb": "model/gltf-binary",
}
"""Media types by name."""
_HEAD = 4_096
"""Bytes of a page that contain its own policy."""
_PIECE = 1_000_000
"""Bytes that are sent at once."""
_SCRIPT = re.compile(rb"script-src '(sha256-[A-Za-z0-9+/]{43}=)'")
_REPORT = (
    "default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; connect-src 'none'; "
    "form-action 'none'; base-uri 'none'; frame-ancestors 'none'; "
    # In an origin of its own, it could not reach the service even if it ran what it should not.
    "sandbox allow-scripts allow-downloads allow-popups allow-popups-to-escape-sandbox; "
    "script-src "
)


def file_response(path: Path, request_headers: Headers | None = None) -> Response:
    """Return the answer that sends a file of a result, as what its name states.

    The file is open from here on: deleted meanwhile, it is sent anyway.

    Args:
        path: The path of the file.
        request_headers: Headers of the request, which state whether the client accepts compression.

    Raises:
        FileNotFoundError: It has been deleted.
    """
    kind, file = KINDS[path.name], path.open("rb")
    headers = {"vary": "Accept, Accept-Encoding"}
    if kind.startswith("text/html"):
        headers[POLICY] = _policy(file.read(_HEAD))
        file.seek(0)
    if path.name == "robot.glb":
        headers["content-disposition"] = f'attachment; filename="{path.name}"'
    if request_headers is not None and _takes_packed(request_headers, kind):
        with suppress(FileNotFoundError):
            packed = path.with_name(path.name + SUFFIX).open("rb")
            file.close()
            file = packed
            headers["content-encoding"] = "gzip"
    size = os.fstat(file.fileno()).st_size
    if size <= _PIECE:
        with file:
            return Response(file.read(), media_type=kind, headers=headers)
    headers["content-length"] = str(size)
    return StreamingResponse(_pieces(file), media_type=kind, headers=headers)


def _takes_packed(request_headers: Headers, kind: str) -> bool:
    """Return whether a client takes a compressed file: for pages, only browsers do."""
    is_for_it = not kind.startswith("text/html") or "text/html" in request_headers.get("accept", "")
    return is_for_it and takes_gzip(request_headers)


def _pieces(file: BinaryIO) -> Iterator[bytes]:
    with file:
        while piece := file.read(_PIECE):
            yield piece


def _policy(begin: bytes) -> str:
    """Return the policy of a report: its own script runs, which its head names by hash."""
    match = _SCRIPT.search(begin)
    return _REPORT + (f"'{match[1].decode('ascii')}'" if match else "'none'")
