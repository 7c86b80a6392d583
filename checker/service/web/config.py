"""Limits and permissions of a service, from the environment."""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import partial
from urllib.parse import urlsplit

from checker.base.errors import InvalidSettings
from checker.base.record import Record
from checker.service.jobs.port import RETENTION_DAYS
from checker.service.store.store import DEFAULT_UPLOAD_LIMIT

_YES = ("1", "true", "yes", "on")
_CENTURY = 36_500
"""Days; calendars end some day."""


class Config(Record):
    """Limits and permissions of a service.

    Attributes:
        tokens: Each lets its bearer upload; without any, everybody may.
        upload_limit: Bytes of an uploaded file.
        public: Whether everybody may use it on purpose. With neither this nor tokens, it answers
            only under names of this machine, so that no other site can imitate it.
        retention_days: Days after which uploads and results are deleted.
        uploads_per_minute: The uploads of one client, by its address; 0 for any number, as on this
            machine.
        uploads_at_once: The uploads of all clients; half of them of one client.
        streams: Watchers of events at once, of all clients.
        streams_per_client: Of them of one client, by its address, which a class may share; on this
            machine, all of them.
        idle_seconds: The time that an upload may pause.
        upload_seconds: The time that any upload may last; a large one may last longer.
        steady: Bytes per second that an upload brings beyond these seconds.
        slowest: Bytes per second that an upload brings on average.
        without_sandbox: Whether workers may check uploads of others without a sandbox.
        base_url: The public address, such as `https://check.example`; empty for that of the
            request.
    """

    tokens: tuple[str, ...] = ()
    upload_limit: int = DEFAULT_UPLOAD_LIMIT
    public: bool = False
    retention_days: int = RETENTION_DAYS
    uploads_per_minute: int = 30
    uploads_at_once: int = 200
    streams: int = 400
    streams_per_client: int = 50
    idle_seconds: float = 20.0
    upload_seconds: float = 100.0
    steady: int = 125_000
    slowest: int = 10_000
    without_sandbox: bool = False
    base_url: str = ""

    @property
    def room(self) -> int:
        """Bytes that the disk must have free: reports and the database need some too."""
        return 2 * self.upload_limit

    @property
    def bytes_per_client(self) -> int:
        """Bytes of all uploads of one client that are under way."""
        return 5 * self.upload_limit

    def longest(self, size: int) -> float:
        """Return how many seconds an upload of so many bytes may last."""
        return self.upload_seconds + size / self.steady

    @property
    def only_here(self) -> bool:
        """True if it is meant for this machine alone."""
        return not (self.tokens or self.public)


def config_from(environment: Mapping[str, str] = os.environ) -> Config:
    """Return what the environment states; an empty variable states nothing.

    Raises:
        InvalidSettings: A variable has a value that makes no sense.
    """
    plain = Config()
    number = partial(_number, environment)
    return Config(
        tokens=_tokens(environment.get("SUBT_CHECK_TOKENS", "")),
        upload_limit=number("SUBT_CHECK_UPLOAD_LIMIT", plain.upload_limit, 1),
        public=_says_yes(environment, "SUBT_CHECK_PUBLIC"),
        retention_days=number("SUBT_CHECK_RETENTION_DAYS", plain.retention_days, 1, _CENTURY),
        uploads_per_minute=number("SUBT_CHECK_UPLOADS_PER_MINUTE", plain.uploads_per_minute),
        streams_per_client=number("SUBT_CHECK_STREAMS_PER_CLIENT", plain.streams_per_client, 1),
        without_sandbox=_says_yes(environment, "SUBT_CHECK_WITHOUT_SANDBOX"),
        base_url=_base_url(environment.get("SUBT_CHECK_BASE_URL", "")),
    )


def _says_yes(environment: Mapping[str, str], name: str) -> bool:
    return environment.get(name, "").lower() in _YES


def _number(
    environment: Mapping[str, str], name: str, default: int, least: int = 0, most: int = 10**15
) -> int:
    text = environment.get(name, "").strip()
    if not text:
        return default
    number = int(text) if text.isascii() and text.isdigit() and len(text) < 17 else -1
    if not least <= number <= most:
        problem = f"{name} is {text!r}, expected a number from {least} to {most}"
        raise InvalidSettings(None, problem)
    return number


def _tokens(text: str) -> tuple[str, ...]:
    """Read tokens; what a header cannot contain would lock its bearer out."""
    tokens = tuple(token.strip() for token in text.split(",") if token.strip())
    if not all(token.isascii() and token.isprintable() and " " not in token for token in tokens):
        problem = (
            "SUBT_CHECK_TOKENS contains characters that are not ASCII letters, digits or signs"
        )
        raise InvalidSettings(None, f"{problem}; separate tokens with commas")
    return tokens


def _base_url(text: str) -> str:
    """Read the address of the service, without a slash at its end."""
    try:
        parts = urlsplit(text.strip().rstrip("/"))
        # Its pages are at the root: a path would lead all links astray.
        fine = parts.scheme in ("http", "https") and bool(parts.hostname) and not parts.path
    except ValueError:
        fine = False
    if text.strip() and (not fine or parts.query or parts.fragment):
        problem = f"SUBT_CHECK_BASE_URL is {text!r}, expected for example 'https://check.example'"
        raise InvalidSettings(None, problem)
    return text.strip().rstrip("/")
