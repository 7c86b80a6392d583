"""Who can reach the service: the address that it listens at, and what that asks for."""

from __future__ import annotations

import socket
from collections.abc import Mapping

from checker.errors import CheckerError
from checker.loopback import is_loopback
from checker.report.wording import plain, shortened
from checker.web.config import config_from


def listening(host: str, port: int) -> socket.socket:
    """Return a socket bound to an address, for child processes to listen at.

    Args:
        host: A name or an address.
        port: 0 for any that is free.

    Raises:
        CheckerError: It cannot be bound.
    """
    shown = f"{plain(shortened(host, 200))} port {port}"
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(
            host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
        bound = socket.socket(family, kind, protocol)
        try:
            bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            bound.bind(address)
        except OSError:
            bound.close()
            raise
    except (OSError, UnicodeError) as error:
        reason = getattr(error, "strerror", None) or error
        raise CheckerError(
            f"{shown} cannot be used ({reason}); choose another --host or --port"
        ) from None
    return bound


def address_of(bound: socket.socket) -> str:
    """Return the address of a bound socket as a browser takes it."""
    host, port = bound.getsockname()[:2]
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


def warning_of(bound: socket.socket, environment: Mapping[str, str]) -> str:
    """Return what to say aloud about who may upload; empty where there is nothing to say.

    Raises:
        CheckerError: Others could upload, and nobody said that they may.
    """
    config = config_from(environment)
    if config.tokens:
        return ""
    if config.public:
        return "without SUBT_CHECK_TOKENS, everybody who reaches it may upload (--public)"
    if not is_loopback(bound.getsockname()[0]):
        raise CheckerError(
            f"{address_of(bound)} can be reached from other machines; set SUBT_CHECK_TOKENS to the "
            "tokens of those who may upload, or let everybody by --public"
        )
    return ""
