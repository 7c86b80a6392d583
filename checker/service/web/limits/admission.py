"""Admission of clients: tokens, rates and places."""

from __future__ import annotations

import hashlib
import secrets
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from math import ceil

from starlette.requests import HTTPConnection

from checker.service.web.answers.refusal import Refused
from checker.service.web.config import Config
from checker.service.web.limits.rates import Rate, Slots, client_of

_SHARE = 2
"""One client has one of so many places, rounded up."""

GUESSES_PER_MINUTE = 30
"""Wrong tokens of one client, where nothing is uploaded."""

_SENDER_DIGITS = 16
"""Length that is enough to distinguish senders."""


class Admission:
    """Lets requests pass or refuses them; used by the event loop alone.

    Attributes:
        uploads_per_minute: The uploads of one client; 0 for any number.
    """

    def __init__(self, config: Config) -> None:
        self._tokens = tuple(token.encode() for token in config.tokens)
        self.uploads_per_minute = 0 if config.only_here else config.uploads_per_minute
        self._rate = Rate(self.uploads_per_minute)
        self._guesses = Rate(GUESSES_PER_MINUTE)
        self._uploads = Slots(config.uploads_at_once, ceil(config.uploads_at_once / _SHARE))
        each = config.streams if config.only_here else config.streams_per_client
        self._streams = Slots(config.streams, each)

    @contextmanager
    def upload(self, request: HTTPConnection) -> Iterator[None]:
        """Admit an upload as long as it lasts.

        Raises:
            Refused: The client sends too many, too many are under way, or its token is wrong.
        """
        client = client_of(request)
        if seconds := self._rate.wait(client):
            raise too_many(seconds)
        if token := bearer(request):
            self._check(token)
        with self._uploads.one(client) as free:
            if not free:
                raise _later(503, "Too many uploads are in progress.", 5, "busy")
            yield

    @contextmanager
    def stream(self, request: HTTPConnection) -> Iterator[None]:
        """Let a client watch a check as long as it lasts.

        Raises:
            Refused: Too many watch.
        """
        with self._streams.one(client_of(request)) as free:
            if not free:
                raise _later(503, "Too many pages follow checks.", 5, "busy")
            yield

    def needs_token(self, request: HTTPConnection) -> Callable[[Mapping[str, str]], None]:
        """Return what refuses the fields of a form without a token, where one is needed."""

        def admit(fields: Mapping[str, str]) -> None:
            if self._tokens and not bearer(request):
                self._check(fields.get("token", ""))

        return admit

    def recognizes(self, request: HTTPConnection) -> bool:
        """Return whether a request has one of the tokens.

        Raises:
            Refused: Too many wrong tokens came from its address; even a valid one is refused.
        """
        token, client = bearer(request), client_of(request)
        if not token:
            return False
        if seconds := ceil(self._guesses.wait(client, 0)):
            raise _later(429, "Too many wrong tokens come from this address.", seconds, "rate")
        is_known = self.knows(token)
        self._guesses.wait(client, 0 if is_known else 1)
        return is_known

    def sender(self, request: HTTPConnection, fields: Mapping[str, str]) -> str:
        """Return the key of the sender in the queues: a digest of its token, or address."""
        token = (bearer(request) or fields.get("token", "")) if self._tokens else ""
        who = f"token {token}" if token else f"address {client_of(request)}"
        return hashlib.sha256(who.encode("utf-8", "replace")).hexdigest()[:_SENDER_DIGITS]

    def knows(self, token: str) -> bool:
        """Return whether it is one of the tokens; valid and invalid ones take the same time."""
        secret = token.strip().encode()
        return sum(secrets.compare_digest(secret, token) for token in self._tokens) > 0

    def _check(self, token: str) -> None:
        if self._tokens and not self.knows(token):
            raise Refused(
                401,
                "This token is not known." if token else "This service needs a token.",
                "Ask the operator of the service for one; programs send it as 'Authorization: "
                "Bearer …', or in the field 'token' before the file.",
                "token",
                {"WWW-Authenticate": "Bearer"},
            )


def bearer(request: HTTPConnection) -> str:
    """Return the token that the header of a request brings; empty without."""
    kind, _, token = request.headers.get("authorization", "").partition(" ")
    return token.strip() if kind.lower() == "bearer" else ""


def too_many(seconds: float) -> Refused:
    """Return the refusal of an upload that is allowed in some seconds."""
    return _later(429, "Too many uploads come from this address.", ceil(seconds), "rate")


def _later(status: int, error: str, seconds: int, cause: str) -> Refused:
    advice = f"Try again in {seconds} s."
    return Refused(status, error, advice, cause, {"Retry-After": str(seconds)})
