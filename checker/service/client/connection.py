"""Requests to a service, with bounds on time and size, repeated where that may help."""

from __future__ import annotations

import http.client
import json
import socket
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from time import monotonic, sleep
from typing import TYPE_CHECKING

from checker.base.errors import CheckerError
from checker.base.progress import Say, say_nothing
from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.service.client.form import Form
from checker.service.client.server import Server

if TYPE_CHECKING:
    from ssl import SSLContext

ANSWER_LIMIT = 1_000_000
"""Bytes of an answer that tells how a check stands."""
_BUSY = (408, 429, 502, 503, 504)
"""Answers of a service, or of what stands before it, that cannot do it just now."""
_SHOWN = 300


class Patience(Record):
    """How long something is waited for.

    Attributes:
        silence: Seconds without a byte.
        answer: Seconds for a whole answer, once the request is sent.
        trouble: Seconds in which a request is tried again.
        pause: Seconds before the first repetition; they double each time.
        longest_pause: Seconds, unless the service asks for more.
    """

    silence: float = 60.0
    answer: float = 300.0
    trouble: float = 120.0
    pause: float = 0.5
    longest_pause: float = 30.0


class Answer(Record):
    """What a service answers.

    Attributes:
        headers: By names in small letters.
        body: Whole.
    """

    status: int
    headers: Mapping[str, str]
    body: bytes

    @property
    def is_busy(self) -> bool:
        """Whether the same request may be taken later."""
        return self.status in _BUSY

    def json(self) -> object:
        """Return the body read as JSON; None if it is none."""
        try:
            return json.loads(self.body)
        except (ValueError, RecursionError):
            return None


class NoAnswer(Exception):
    """A request came to nothing; the text says why."""


class Connection(Record):
    """Speaks with one service, and with no other: it follows no redirect.

    Attributes:
        token: Shown to the service; may be empty.
        say: Told why a request is repeated.
    """

    server: Server
    token: str = ""
    patience: Patience = Patience()
    say: Say = say_nothing

    def ask(
        self, method: str, path: str, form: Form | None = None, limit: int = ANSWER_LIMIT
    ) -> Answer:
        """Send a request, again and again while the service is busy or away, and return its answer.

        Args:
            method: Of HTTP.
            path: Below the address of the service.
            form: What goes with it.
            limit: Bytes of the answer that are read.

        Raises:
            CheckerError: No answer of use comes.
        """
        ends, pause = monotonic() + self.patience.trouble, self.patience.pause
        while True:
            wanted = 0.0
            try:
                answer = self._once(method, path, form, limit)
                if not answer.is_busy:
                    return self._direct(answer)
                trouble, wanted = f"answers {answer.status}", _retry_after(answer)
            except NoAnswer as problem:
                trouble = str(problem)
            wait = max(min(pause, self.patience.longest_pause), wanted)
            if monotonic() + wait > ends:
                raise CheckerError(f"{self.server} {trouble}; try again later")
            self.say(f"{self.server} {trouble}; trying again in {wait:.0f} s")
            sleep(wait)
            pause *= 2.0

    def _direct(self, answer: Answer) -> Answer:
        """Return an answer unless it sends elsewhere: the token is for nobody else.

        Raises:
            CheckerError: It does.
        """
        if 300 <= answer.status < 400:
            where = plain(shortened(answer.headers.get("location", "elsewhere"), _SHOWN))
            raise CheckerError(
                f"{self.server} sends on to {where}; if that is right, give its address as --server"
            )
        return answer

    def _once(self, method: str, path: str, form: Form | None, limit: int) -> Answer:
        connection = self._connection()
        try:
            self._send(connection, method, path, form)
            with _cut_off(connection.sock, self.patience.answer):
                response = connection.getresponse()
                body = response.read(limit + 1)
        except (socket.gaierror, ValueError) as error:
            if getattr(error, "errno", 0) == socket.EAI_AGAIN:
                raise NoAnswer(f"cannot be reached ({_cause(error)})") from None
            # Neither a wrong name nor a wrong certificate becomes right in a minute.
            raise CheckerError(f"{self.server} cannot be reached: {_cause(error)}") from None
        except (OSError, http.client.HTTPException) as error:
            raise NoAnswer(f"does not answer ({_cause(error)})") from None
        finally:
            connection.close()
        if len(body) > limit:
            raise CheckerError(f"{self.server} answers with more than {limit / 1e6:g} MB")
        # Without a length, what was cut off could not be told from what is whole.
        if response.length != 0 and not response.chunked:
            raise NoAnswer("hangs up in the middle of its answer")
        headers = {name.lower(): value for name, value in response.getheaders()}
        return Answer(response.status, headers, body)

    def _connection(self) -> http.client.HTTPConnection:
        host, port, silence = self.server.host, self.server.port, self.patience.silence
        if self.server.scheme == "http":
            return http.client.HTTPConnection(host, port, timeout=silence)
        return http.client.HTTPSConnection(host, port, timeout=silence, context=_trust())

    def _send(
        self, connection: http.client.HTTPConnection, method: str, path: str, form: Form | None
    ) -> None:
        headers = {"Accept": "application/json", "User-Agent": "subt-check"}
        if self.token:
            headers["Authorization"] = f"Bearer {self.token}"
        body: Iterator[bytes] | None = None
        if form is not None:
            headers |= {"Content-Type": form.content_type, "Content-Length": str(form.length)}
            body = form.pieces()
        # A service that refuses an upload answers before it has all of it, and hangs up.
        with suppress(BrokenPipeError, ConnectionResetError):
            connection.request(method, self.server.base + path, body, headers)


def _trust() -> SSLContext:
    import ssl

    return ssl.create_default_context()


@contextmanager
def _cut_off(connected: socket.socket, seconds: float) -> Iterator[None]:
    """Hang up after so many seconds, however slowly an answer drips.

    Raises:
        NoAnswer: It came to that.
    """
    late = threading.Event()

    def hang_up() -> None:
        late.set()
        with suppress(OSError):
            connected.shutdown(socket.SHUT_RDWR)

    timer = threading.Timer(seconds, hang_up)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        if late.is_set():
            raise NoAnswer(f"takes longer than {seconds:g} s to answer")


def _retry_after(answer: Answer) -> float:
    """Return the seconds that a service asks to wait; 0 where it does not say."""
    text = answer.headers.get("retry-after", "")
    return float(text) if text.isascii() and text.isdecimal() and len(text) < 10 else 0.0


def _cause(error: Exception) -> str:
    said = getattr(error, "strerror", None) or str(error) or type(error).__name__
    return plain(shortened(said, _SHOWN))
