"""Who can reach the service: the address that it listens at, and what that asks for.

What others upload is read in a sandbox (`checker.base.sandbox`), unless somebody takes the risk.
"""

from __future__ import annotations

import socket
from collections.abc import Callable, Mapping, Sequence

from checker.base.errors import CheckerError
from checker.base.sandbox.layers import SECCOMP, Layer, hides_files
from checker.base.words import plain, shortened
from checker.service.loopback import is_loopback
from checker.service.web.config import config_from


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


def risk_of(environment: Mapping[str, str], layers: Callable[[], Sequence[Layer]]) -> str:
    """Return what to say aloud where uploads of others are read without a sandbox; else nothing.

    Args:
        environment: Says who may upload, and whether the risk is taken.
        layers: Says which layers hold; asked only if it matters.

    Raises:
        CheckerError: No layer hides files, and nobody said that it goes without.
    """
    config = config_from(environment)
    if config.only_here:
        return ""
    found = layers()
    if hides_files(found):
        return ""
    if config.without_sandbox:
        return f"no layer hides files: {_RISK} (--without-sandbox)"
    raise CheckerError(
        f"no layer hides files from what others upload ({_missing(found)}); install bubblewrap or "
        "use a kernel with Landlock, of which `subt-check doctor` tells more, or take the risk by "
        f"--without-sandbox: {_RISK}"
    )


_RISK = "a package that takes over its reader reads all that this user can, uploads of others too"


def _missing(layers: Sequence[Layer]) -> str:
    """Return why none of the layers that could hide files does."""
    said = [f"{each.name}: {each.words}" for each in layers if each.name != SECCOMP]
    return plain(shortened("; ".join(said) or "the process that keeps them ends at once", 300))
