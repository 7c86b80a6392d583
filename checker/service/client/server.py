"""The address of a service."""

from __future__ import annotations

import re
from urllib.parse import urlsplit

from checker.base.errors import CheckerError
from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.service.exposure import is_loopback

_PORTS = {"http": 80, "https": 443}
_HOST = re.compile(r"[A-Za-z0-9._:-]+")


class Server(Record):
    """Address of a service.

    Attributes:
        scheme: `http` or `https`.
        host: Name or address, without brackets.
        port: The TCP port.
        base: Path of the service, without a slash at its end; usually empty.
    """

    scheme: str
    host: str
    port: int
    base: str = ""

    def __str__(self) -> str:
        """Return the address as a browser shows it."""
        host = f"[{self.host}]" if ":" in self.host else self.host
        port = "" if self.port == _PORTS[self.scheme] else f":{self.port}"
        return f"{self.scheme}://{host}{port}{self.base}"

    @property
    def is_here(self) -> bool:
        """True if it is this machine, so that no third party can read along."""
        return is_loopback(self.host)


def parse_server(text: str) -> Server:
    """Read the address of a service, such as `https://check.example`.

    Raises:
        CheckerError: It is none.
    """
    try:
        parts = urlsplit(text.strip())
        port = parts.port or _PORTS.get(parts.scheme, 0)
        host = (parts.hostname or "").encode("idna").decode("ascii")
    except (ValueError, UnicodeError):
        raise _no_server(text) from None
    # What is quoted nowhere must not slip into a request: the path of the address goes into it.
    plain_path = parts.path.isascii() and parts.path.isprintable() and " " not in parts.path
    extra = parts.query or parts.fragment or parts.username is not None
    if parts.scheme not in _PORTS or not _HOST.fullmatch(host) or extra or not plain_path:
        raise _no_server(text)
    return Server(parts.scheme, host, port, parts.path.rstrip("/"))


def _no_server(text: str) -> CheckerError:
    address = plain(shortened(text, 200))
    return CheckerError(
        f"'{address}' is not the address of a service, expected for example https://check.example"
    )
