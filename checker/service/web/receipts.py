"""The secret of a check: given to the sender of a package, and required to end a check."""

from __future__ import annotations

import re
from datetime import timedelta

from starlette.requests import Request
from starlette.responses import Response

from checker.service.jobs.port import Receipt
from checker.service.web.answers.refusal import Refused
from checker.service.web.services import Services

SECRET = "Subt-Check-Secret"  # noqa: S105 - the name of a header
"""Brings the secret of a check."""
KEY = "Idempotency-Key"
"""Brings a key of the client's own: the same upload with the same key is one check."""
KEY_PATTERN = re.compile("[ -~]{22,200}")
"""With a guessed key and the upload, anyone can compute the link of its check."""
_COOKIE = "subt-check-secret"


def key_of(request: Request) -> str:
    """Return the key that a request brings; empty without.

    Raises:
        Refused: It could be guessed, or is too long.
    """
    key = request.headers.get(KEY)
    if key is None or KEY_PATTERN.fullmatch(key):
        return key or ""
    raise Refused(
        422,
        f"The header {KEY} is wrong, expected 22 to 200 printable characters of ASCII.",
        "Send a new random key with each upload, such as a UUID, and the same one to repeat it.",
        "key",
    )


def give(response: Response, receipt: Receipt, request: Request, services: Services) -> None:
    """Make a browser keep the secret of a check, for the page of this check alone."""
    response.set_cookie(
        _COOKIE,
        receipt.secret,
        max_age=int(timedelta(days=services.config.retention_days).total_seconds()),
        path=f"/checks/{receipt.id}",
        secure=services.address(request).startswith("https:"),
        httponly=True,
        samesite="strict",
    )


def stored_secret(request: Request) -> str:
    """Return the secret that a browser keeps for the page that it requests; empty for none."""
    return request.cookies.get(_COOKIE, "")


def take(response: Response, id: str) -> None:
    """Make a browser delete the secret of a check."""
    response.delete_cookie(_COOKIE, path=f"/checks/{id}", httponly=True, samesite="strict")


def cancel(services: Services, id: str, secret: str) -> None:
    """End a check, unless it is over.

    Raises:
        Refused: There is none, or the secret is not its own.
    """
    services.check(id)
    if not services.jobs.cancel(id, secret):
        services.check(id)  # it may have gone meanwhile
        raise not_yours("cancel its check")


def delete(services: Services, id: str, secret: str) -> None:
    """End a check and forget it.

    Raises:
        Refused: There is none, or the secret is not its own.
    """
    services.check(id)
    if not services.jobs.delete(id, secret):
        services.check(id)
        raise not_yours("delete its check")


def not_yours(what: str) -> Refused:
    """Return the refusal of what only the sender of a package may do."""
    return Refused(
        403,
        f"Only the person who uploaded this package can {what}.",
        f"Use the browser that uploaded it; programs send the secret in the header '{SECRET}'.",
        "secret",
    )
