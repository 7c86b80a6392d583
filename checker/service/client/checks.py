"""A check on a service: ordered, waited for, cancelled, and its results fetched."""

from __future__ import annotations

import enum
from collections.abc import Iterator
from time import sleep
from typing import Annotated
from urllib.parse import quote, unquote

from msgspec import Meta, Struct

from checker.base.errors import CheckerError
from checker.base.output import Say
from checker.base.record import Record
from checker.base.words import count, plain, shortened
from checker.report.files import ARTEFACT_NAME, INDEX
from checker.report.json_report import SIZE_LIMIT
from checker.service.client.connection import Answer, Connection
from checker.service.client.upload import Upload

FILE_LIMIT = SIZE_LIMIT
"""Bytes of a result's file."""
_CHECKS = "/api/checks"
_FIRST_PAUSE, _LONGEST_PAUSE = 0.3, 2.0
"""Seconds between two looks at a check."""
_SHOWN = 600


class End(enum.StrEnum):
    """End of a check in the words of the API: `REFUSED` by its package, `FAILED` by us."""

    DONE = "done"
    REFUSED = "refused"
    FAILED = "failed"
    CANCELLED = "cancelled"


class Given(Struct, frozen=True):
    """Answer of the service to an upload."""

    id: Annotated[str, Meta(pattern=r"^[A-Za-z0-9_-]{16,100}\Z")]
    secret: Annotated[str, Meta(pattern=r"^[A-Za-z0-9_-]{16,100}\Z")]


class Problem(Struct, frozen=True):
    """Answer of the service to a refused request."""

    error: str
    advice: str | None = None


class Standing(Struct, frozen=True):
    """State of a check, as far as the client uses it; the members are those of the API."""

    stage: str
    words: str = ""
    ahead: int = 0
    files: tuple[str, ...] = ()

    @property
    def end(self) -> End | None:
        """End of the check; None while it runs."""
        return next((end for end in End if end == self.stage), None)

    def __str__(self) -> str:
        """State it in a few words."""
        text = plain(shortened(self.words or self.stage, _SHOWN))
        before = f" ({count(self.ahead, 'check')} before it)" if self.ahead > 0 else ""
        return text + before


class Check(Record):
    """One check on a service.

    Attributes:
        secret: Cancels it.
    """

    connection: Connection
    id: str
    secret: str

    @property
    def link(self) -> str:
        """The address of its page."""
        return f"{self.connection.server}/checks/{self.id}"

    @property
    def _path(self) -> str:
        return f"{_CHECKS}/{self.id}"

    def names(self, standing: Standing) -> Iterator[str]:
        """Yield the names of the result's files, such as `rover/report.html`."""
        for address in standing.files:
            name = unquote(address.removeprefix(f"{self._path}/")).removeprefix("packages/")
            if ARTEFACT_NAME.fullmatch(name):
                yield name

    def wait(self, say: Say) -> Standing:
        """Wait until the check ends, and return how.

        Raises:
            CheckerError: The service does not state it.
        """
        last_message, pause = "", _FIRST_PAUSE
        while True:
            standing = self._standing()
            if standing.end is not None:
                return standing
            if str(standing) != last_message:
                last_message, pause = str(standing), _FIRST_PAUSE
                say(last_message)
            sleep(pause)
            pause = min(1.5 * pause, _LONGEST_PAUSE)

    def cancel(self) -> None:
        """End the check.

        Raises:
            CheckerError: The service does not do it.
        """
        headers = {"Subt-Check-Secret": self.secret}
        answer = self.connection.ask("POST", f"{self._path}/cancel", headers=headers)
        if answer.status not in (200, 404):
            raise _refusal(self.connection, answer)

    def file(self, name: str) -> bytes | None:
        """Return a file of the result; None if there is none of that name.

        Raises:
            CheckerError: The service does not give it.
        """
        inner = "packages/" if "/" in name or name == INDEX else ""
        path = f"{self._path}/{inner}{quote(name)}"
        answer = self.connection.ask("GET", path, limit=FILE_LIMIT)
        if answer.status == 404:
            return None
        if answer.status != 200:
            raise _refusal(self.connection, answer)
        return answer.body

    def _standing(self) -> Standing:
        answer = self.connection.ask("GET", self._path)
        standing = answer.read_as(Standing) if answer.status == 200 else None
        if standing is None:
            raise _refusal(self.connection, answer)
        return standing


def order(connection: Connection, upload: Upload) -> Check:
    """Upload a file and return its check; sent again since an answer got lost, it is the same one.

    Raises:
        CheckerError: The service does not take it; the text states why.
    """
    headers = {"Idempotency-Key": upload.key}
    answer = connection.ask("POST", _CHECKS, upload, headers=headers)
    created = answer.read_as(Given) if answer.status == 201 else None
    if created is None:
        raise _refusal(connection, answer)
    return Check(connection, created.id, created.secret)


def _refusal(connection: Connection, answer: Answer) -> CheckerError:
    """Return what a service states against a request, in its own words where it has some."""
    problem = answer.read_as(Problem)
    if problem is None:
        return CheckerError(
            f"{connection.server} answers {answer.status}, but not like a subt-check service; "
            "check the address"
        )
    text = " ".join(filter(None, (problem.error, problem.advice)))
    return CheckerError(f"{connection.server}: {plain(shortened(text, _SHOWN))}")
