"""Requests to a service, with bounds on time and size, repeated where that may help."""

from __future__ import annotations

import socket
import ssl
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, closing, contextmanager, nullcontext, suppress
from functools import cache
from time import monotonic, sleep
from typing import TYPE_CHECKING, Any, TypeVar

import msgspec

from checker.base.errors import CheckerError, Unreachable
from checker.base.output import Say, say_nothing
from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.service.client.server import Server
from checker.service.client.upload import Upload

if TYPE_CHECKING:
    import httpx

T = TypeVar("T")
Trace = Callable[[str, Mapping[str, Any]], None]
"""Called with the name of each step of a request."""
ANSWER_LIMIT = 1_000_000
"""Bytes of an answer with the state of a check."""
_BUSY = (408, 429, 502, 503, 504)
"""Answers of a service, or of what is before it, that cannot do it just now."""
_SHOWN = 300


class Patience(Record):
    """Timeouts and repetitions of requests.

    Attributes:
        silence: Seconds without a byte.
        answer: Seconds for a whole answer, once the request is sent.
        trouble: Seconds during which a request is tried again.
        pause: Seconds before the first repetition; they double each time.
        longest_pause: Seconds, unless the service requests more.
    """

    silence: float = 60.0
    answer: float = 300.0
    trouble: float = 120.0
    pause: float = 0.5
    longest_pause: float = 30.0


class Answer(Record):
    """Answer of a service.

    Attributes:
        headers: Their names in any case.
        body: Whole.
    """

    status: int
    headers: Mapping[str, str]
    body: bytes

    def read_as(self, kind: type[T]) -> T | None:
        """Return the body read as JSON of a type; None if it is none."""
        try:
            return msgspec.json.decode(self.body, type=kind)
        except (msgspec.MsgspecError, ValueError, RecursionError):
            return None

    @property
    def retry_after(self) -> float:
        """Seconds that the service requests to wait; 0 if it does not state it."""
        text = self.headers.get("retry-after", "")
        return float(text) if text.isascii() and text.isdecimal() and len(text) < 10 else 0.0


class NoAnswer(Exception):
    """A request failed; the text states why."""


class Connection(Record):
    """Connection to one service only, without redirects and proxies.

    Attributes:
        token: Shown to the service; may be empty.
        say: Called with the reason when a request is repeated.
    """

    server: Server
    token: str = ""
    patience: Patience = Patience()
    say: Say = say_nothing

    def ask(
        self,
        method: str,
        path: str,
        upload: Upload | None = None,
        limit: int = ANSWER_LIMIT,
        headers: Mapping[str, str] | None = None,
    ) -> Answer:
        """Send a request, again and again while the service is busy or away, and return its answer.

        Args:
            method: The HTTP method.
            path: The path below the address of the service.
            upload: The content to send.
            limit: Bytes of the answer that are read.
            headers: Headers to send besides the usual ones.

        Raises:
            CheckerError: There is no usable answer.
        """
        ends, pause = monotonic() + self.patience.trouble, self.patience.pause
        while True:
            least_wait = 0.0
            try:
                answer = self._once(method, path, upload, limit, headers or {})
                if answer.status not in _BUSY:
                    return self._direct(answer)
                trouble, least_wait = f"answers {answer.status}", answer.retry_after
            except NoAnswer as problem:
                trouble = str(problem)
            wait = max(min(pause, self.patience.longest_pause), least_wait)
            if monotonic() + wait > ends:
                raise Unreachable(f"{self.server} {trouble}; try again later")
            self.say(f"{self.server} {trouble}; trying again in {wait:.0f} s")
            sleep(wait)
            pause *= 2.0

    def _direct(self, answer: Answer) -> Answer:
        """Return an answer unless it sends elsewhere: the token is for this server alone.

        Raises:
            CheckerError: It does.
        """
        if 300 <= answer.status < 400:
            where = plain(shortened(answer.headers.get("location", "elsewhere"), _SHOWN))
            raise CheckerError(
                f"{self.server} redirects to {where}; if that is right, give this address "
                "with --server"
            )
        return answer

    def _once(
        self,
        method: str,
        path: str,
        upload: Upload | None,
        limit: int,
        headers: Mapping[str, str],
    ) -> Answer:
        import httpx

        form: AbstractContextManager[Mapping[str, Any]] = (
            upload.form() if upload else nullcontext({})
        )
        # A client above the transport would read where the service sends on to, and keep cookies.
        transport = httpx.HTTPTransport(verify=_trust(), trust_env=False)
        try:
            with transport, form as members, _cut_off(self.patience.answer) as trace:
                request = self._request(method, path, headers, members, trace)
                with closing(transport.handle_request(request)) as response:
                    body = self._body(response, limit)
        except (httpx.TransportError, httpx.InvalidURL) as error:
            cause = _cause(error)
            reason = plain(shortened(getattr(cause, "strerror", None) or str(cause), _SHOWN))
            if _is_final(cause):
                raise CheckerError(f"{self.server} cannot be reached: {reason}") from None
            raise NoAnswer(f"does not answer ({reason})") from None
        return Answer(response.status_code, response.headers, body)

    def _request(
        self,
        method: str,
        path: str,
        more: Mapping[str, str],
        members: Mapping[str, Any],
        trace: Trace,
    ) -> httpx.Request:
        import httpx

        headers = {"Accept": "application/json", "User-Agent": "subt-check", **more}
        # No compressed answer is requested, and nothing is unpacked: it could be a bomb.
        headers |= {"Accept-Encoding": "identity", "Connection": "close"}
        if self.token:
            headers["Authorization"] = f"Bearer {self.token}"
        silence = httpx.Timeout(self.patience.silence).as_dict()
        return httpx.Request(
            method,
            f"{self.server}{path}",
            headers=headers,
            extensions={"timeout": silence, "trace": trace},
            **members,
        )

    def _body(self, response: httpx.Response, limit: int) -> bytes:
        body = b""
        for piece in response.iter_raw():
            body += piece
            if len(body) > limit:
                raise CheckerError(f"{self.server} answers with more than {limit / 1e6:g} MB")
        # Without a length, a truncated answer could not be recognised.
        has_end = {"content-length", "transfer-encoding"} & {*response.headers}
        if not has_end and response.status_code != 204:
            raise NoAnswer("hangs up in the middle of its answer")
        return body


@cache
def _trust() -> ssl.SSLContext:
    """Return the TLS context with the system's certificates, not by those that a library brings."""
    return ssl.create_default_context()


@contextmanager
def _cut_off(seconds: float) -> Iterator[Trace]:
    """Hang up so many seconds after a request is sent, however slowly its answer drips.

    Yields:
        Messages about the steps of the request.

    Raises:
        NoAnswer: No answer came.
    """
    late = threading.Event()
    streams: list[Any] = []

    def hang_up() -> None:
        late.set()
        with suppress(OSError):
            streams[-1].get_extra_info("socket").shutdown(socket.SHUT_RDWR)

    def trace(event: str, details: Mapping[str, Any]) -> None:
        if event in ("connection.connect_tcp.complete", "connection.start_tls.complete"):
            streams.append(details["return_value"])
        elif event == "http11.receive_response_headers.started":
            timer.start()

    timer = threading.Timer(seconds, hang_up)
    timer.daemon = True
    try:
        yield trace
    finally:
        timer.cancel()
        if late.is_set():
            raise NoAnswer(f"takes longer than {seconds:g} s to answer")


def _cause(error: BaseException) -> BaseException:
    """Return what an error began with: the library wraps those of the system."""
    while inner := error.__cause__ or error.__context__:
        error = inner
    return error


def _is_final(cause: BaseException) -> bool:
    """Return whether the error is permanent, such as a wrong name or certificate."""
    import httpx

    if isinstance(cause, socket.gaierror):
        return cause.errno != socket.EAI_AGAIN
    return isinstance(cause, httpx.InvalidURL | ValueError)
