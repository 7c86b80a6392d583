"""Requests that another site makes a browser send are refused; so are uploads, politely."""

from __future__ import annotations

import asyncio
import re
from dataclasses import dataclass
from time import monotonic
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import Request
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from checker.base.record import Record
from checker.service.exposure import is_loopback
from checker.service.web.answers.problems import refusal_answer
from checker.service.web.answers.refusal import Refused
from checker.service.web.config import Config

# Refused uploads are read on for a moment, so that the refusal arrives.
#
# A server that closes a connection with unread bytes has the system reset it, and the client loses
# the answer that says why.


LINGER_SECONDS = 10.0
PAUSE_SECONDS = 1.0
"""A client that sends nothing for so long has read the answer, or never will."""


@dataclass
class _Body:
    """The body of a request; `read` states whether all of it has come."""

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


class UnreadBodies(Record):
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


_READING = ("GET", "HEAD", "OPTIONS")
_HOST = re.compile(r"(\[[0-9A-Fa-f:.]{2,45}\]|[A-Za-z0-9._-]{1,253})(?::\d{1,5})?")


class OwnOrigin(Record):
    """Refuses requests for another host, and changes on behalf of another site.

    A service for this machine alone answers to names of this machine only: any site can give its
    own name this machine's address (DNS rebinding), but not change the name that browsers send.
    """

    app: ASGIApp
    config: Config

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] == "http":
            request = Request(scope)
            refused = self._misdirected(request) or self._cross_site(request)
            if refused is not None:
                await refusal_answer(request, refused)(scope, receive, send)
                return
        await self.app(scope, receive, send)

    def _misdirected(self, request: Request) -> Refused | None:
        host = request.headers.get("host", "")
        match = _HOST.fullmatch(host)
        name = match[1].lower() if match else ""
        ours = urlsplit(self.config.base_url).hostname
        if match and (not self.config.only_here or name == ours or is_loopback(name)):
            return None
        return Refused(
            421,
            "This service does not answer under this host name.",
            "Use http://localhost with its port; the operator can set SUBT_CHECK_BASE_URL.",
            "host",
        )

    def _cross_site(self, request: Request) -> Refused | None:
        """Judge by what browsers add to each request; programs send neither header."""
        if request.method in _READING:
            return None
        site = request.headers.get("sec-fetch-site")
        origin = request.headers.get("origin")
        if site in (None, "same-origin", "none") and (
            origin is None or self._is_ours(origin, request)
        ):
            return None
        error = "The request comes from another site."
        return Refused(403, error, "Use the form of this service.", "origin")

    def _is_ours(self, origin: str, request: Request) -> bool:
        host = origin.partition("://")[2].lower()
        here = {request.headers.get("host", "").lower()}
        if self.config.base_url:
            here.add(urlsplit(self.config.base_url).netloc.lower())
        return host in here
