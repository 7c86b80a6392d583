"""Transfer of an upload from a request into the store; nothing is left if it fails."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, MutableMapping
from dataclasses import dataclass
from functools import partial
from time import monotonic
from typing import Any

from anyio import to_thread
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request

from checker.base.errors import UnreadableInput
from checker.base.words import plain
from checker.package.inputs import ARCHIVE_SUFFIXES
from checker.rulebook.profiles import profile_names
from checker.service.jobs.port import Order, Receipt
from checker.service.store.workplace import Incoming, TooLarge
from checker.service.web.answers.refusal import Refused, sentence
from checker.service.web.config import Config
from checker.service.web.limits.admission import too_many
from checker.service.web.limits.rates import client_of
from checker.service.web.limits.space import Claim, no_room
from checker.service.web.receipts import key_of
from checker.service.web.services import Services
from checker.service.web.uploads.form import ROOM, UploadForm

AT_ONCE = 1_048_576
"""Bytes of each upload that the event loop writes itself. The system takes them into its memory in
less time than it takes to change to a thread and back; more of them may have to wait for the disk.
"""


async def new_check(request: Request, services: Services) -> Receipt:
    """Take the upload form of a request and order a check of its file.

    Args:
        request: Its body is a multipart form: `token` where one is needed and no header brings
            it, `profile` if wanted, then `file`.
        services: Take the file and the order.

    Returns:
        The receipt of the check; the same one for the same upload with the same key.

    Raises:
        Refused: The upload is not taken; nothing of it is left.
        JobsUnreachable: The order cannot be taken now.
    """
    config = services.config
    with services.admission.upload(request):
        await _count(request, services)
        size = _announced(request, config)
        try:
            # Unless the store has it by then, nothing of it is left behind this.
            with (
                services.space.reserve(client_of(request), size) as claim,
                services.store.incoming(config.upload_limit) as incoming,
            ):
                receipt = await _received(request, services, incoming, claim)
        except TooLarge:
            raise too_large(config.upload_limit) from None
        except OSError as error:
            raise no_room(error) from None
    services.metrics.uploads.inc()
    return receipt


async def _count(request: Request, services: Services) -> None:
    """Count an upload in all web processes together.

    Raises:
        Refused: The client has sent too many to some of them.
    """
    if per_minute := services.admission.uploads_per_minute:
        client, wait = client_of(request), services.jobs.wait
        if seconds := await run_in_threadpool(wait, client, per_minute):
            raise too_many(seconds)


async def _received(
    request: Request, services: Services, incoming: Incoming, claim: Claim
) -> Receipt:
    """Read the form, and order a check of its file; see `new_check`."""
    key, admit = key_of(request), services.admission.needs_token(request)
    form = UploadForm(request.headers.get("content-type", ""), incoming.write, admit)
    async for piece in _pieces(request, services.config, claim.size):
        services.space.extend(claim, incoming.size + len(piece))
        if incoming.size < AT_ONCE:
            form.feed(piece)
        else:
            await run_in_threadpool(form.feed, piece)
        claim.written = incoming.size
    form.end()
    profile = _profile(form.fields.get("profile", ""))
    sender = services.admission.sender(request, form.fields)
    take = partial(_ordered, services, incoming, form.name, profile, sender, key)
    async with services.lines.place(sender):
        return await to_thread.run_sync(take, limiter=services.threads)


def _ordered(
    services: Services, incoming: Incoming, name: str, profile: str, sender: str, key: str
) -> Receipt:
    """Look at an upload that has come whole, keep it, order its check, and return the receipt."""
    if name.lower().endswith(ARCHIVE_SUFFIXES):
        try:
            services.indexes.check(incoming.path, name)
        except UnreadableInput as error:
            reason = plain(f"{name} {error.reason}.")
            raise Refused(422, reason, sentence(error.advice), "archive") from None
        except OSError as error:
            raise _not_looked_at(name, error) from None
    return services.jobs.submit(Order(incoming.finish(), name, profile, sender), key)


def _not_looked_at(name: str, error: OSError) -> Refused:
    reason = plain(error.strerror or "the system fails")
    return Refused(
        503,
        f"The service cannot look at {name} now: {reason}.",
        "Try again in 10 s.",
        "system",
        {"Retry-After": "10"},
    )


def too_large(limit: int) -> Refused:
    """Return the refusal of a file that is larger than the limit."""
    return Refused(
        413,
        f"The file is larger than the {limit / 1e6:g} MB allowed.",
        "Remove files that the package does not need, or reduce its meshes and textures.",
        "size",
    )


def _announced(request: Request, config: Config) -> int:
    """Return how many bytes a request may bring; as many as any if it does not state it.

    Raises:
        Refused: It states about itself that it is too large.
    """
    length = request.headers.get("content-length", "")
    if not (length.isdecimal() and len(length) <= 20):
        return config.upload_limit
    if int(length) > config.upload_limit + ROOM:
        raise too_large(config.upload_limit)
    return min(int(length), config.upload_limit)


@dataclass
class _Patience:
    """Time limit of an upload, which grows with each received byte.

    Attributes:
        longest: Greatest number of seconds that it may last.
        started: The start time by the monotonic clock.
        received: Bytes so far.
    """

    config: Config
    longest: float
    started: float
    received: int = 0

    @property
    def left(self) -> float:
        """Seconds from now."""
        config, passed = self.config, monotonic() - self.started
        bought = config.idle_seconds + self.received / config.slowest
        return min(bought, self.longest) - passed


async def _pieces(request: Request, config: Config, size: int) -> AsyncIterator[bytes]:
    """Yield the body of a request piece by piece.

    Raises:
        Refused: It comes too slowly, is longer than any form, or ends early.
    """
    patience = _Patience(config, config.longest(size), monotonic())
    more = True
    while more:
        message = await _message(request, config, patience)
        if message["type"] == "http.disconnect":
            raise Refused(400, "The upload was cut off.", "Send it again.", "cut")
        piece: bytes = message.get("body", b"")
        more = message.get("more_body", False)
        patience.received += len(piece)
        if patience.received > config.upload_limit + ROOM:
            raise too_large(config.upload_limit)
        if piece:
            yield piece


async def _message(
    request: Request, config: Config, patience: _Patience
) -> MutableMapping[str, Any]:
    try:
        async with asyncio.timeout(min(config.idle_seconds, max(patience.left, 0.0))):
            return await request.receive()
    except TimeoutError:
        raise _too_slow(patience) from None


def _too_slow(patience: _Patience) -> Refused:
    least, longest = patience.config.slowest / 1e3, patience.longest
    return Refused(
        408,
        f"The upload is too slow, expected {least:g} kB/s or more without long breaks, and at "
        f"most {longest:.0f} s.",
        "Send it again over a better connection, or reduce it.",
        "slow",
    )


def _profile(name: str) -> str:
    known = profile_names()
    if name and name not in known:
        choices = ", ".join(known)
        raise Refused(422, "There is no such profile.", f"Choose one of {choices}.", "profile")
    return name
