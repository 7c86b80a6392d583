"""Access to the service: the address that it listens on, and what that requires.

What others upload is read in a sandbox (`checker.base.sandbox`), unless the operator accepts the
risk.
"""

from __future__ import annotations

import errno
import ipaddress
import socket
from collections.abc import Callable, Mapping, Sequence
from time import monotonic, sleep

from checker.base.errors import CheckerError
from checker.base.sandbox.layers import SECCOMP, Layer, hides_files
from checker.base.words import plain, shortened
from checker.service.web.config import config_from

_ENDING_SECONDS, _PAUSE_SECONDS = 3.0, 0.1
"""A killed service keeps its address until its processes end; the next one starts at once."""

# Whether a host is the machine itself: no third party is on the way to it.


def is_loopback(host: str) -> bool:
    """Return whether a name or address, in brackets or without, is that of the machine itself."""
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return host == "localhost" or host.endswith(".localhost")


def listening(host: str, port: int) -> socket.socket:
    """Return a socket bound to an address, for child processes to listen at.

    Args:
        host: A name or an address.
        port: 0 for any that is free.

    Raises:
        CheckerError: It cannot be bound.
    """
    label = f"{plain(shortened(host, 200))} port {port}"
    try:
        return _bound(host, port)
    except (OSError, UnicodeError) as error:
        reason = getattr(error, "strerror", None) or error
        raise CheckerError(
            f"{label} cannot be used ({reason}); choose another --host or --port"
        ) from None


def _bound(host: str, port: int) -> socket.socket:
    """Return a bound socket; an address that is in use is waited for a little."""
    family, kind, protocol, _, address = socket.getaddrinfo(
        host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
    )[0]
    bound, ends = socket.socket(family, kind, protocol), monotonic() + _ENDING_SECONDS
    try:
        bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        while True:
            try:
                bound.bind(address)
            except OSError as error:
                if error.errno != errno.EADDRINUSE or monotonic() > ends:
                    raise
                sleep(_PAUSE_SECONDS)
            else:
                return bound
    except BaseException:
        bound.close()
        raise


def address_of(bound: socket.socket) -> str:
    """Return the address of a bound socket as a browser takes it."""
    host, port = bound.getsockname()[:2]
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


def warning_of(bound: socket.socket, environment: Mapping[str, str]) -> str:
    """Return the warning about the permission to upload; empty without one.

    Raises:
        CheckerError: Others could upload without explicit permission.
    """
    config = config_from(environment)
    if config.tokens:
        return ""
    if config.public:
        return (
            "without SUBT_CHECK_TOKENS, everybody who can reach the service may upload (--public)"
        )
    if not is_loopback(bound.getsockname()[0]):
        raise CheckerError(
            f"{address_of(bound)} can be reached from other machines; set SUBT_CHECK_TOKENS to the "
            "tokens of those who may upload, or allow everybody with --public"
        )
    return ""


def risk_of(environment: Mapping[str, str], layers: Callable[[], Sequence[Layer]]) -> str:
    """Return a warning if uploads of others are read without a sandbox; else nothing.

    Args:
        environment: The variables with the permission to upload and to take the risk.
        layers: Returns the active layers; called only if it matters.

    Raises:
        CheckerError: No layer hides files, and this was not explicitly permitted.
    """
    config = config_from(environment)
    if config.only_here:
        return ""
    held = layers()
    if hides_files(held):
        return ""
    if config.without_sandbox:
        return f"no sandbox layer hides files: {_RISK} (--without-sandbox)"
    raise CheckerError(
        f"no sandbox layer hides files from uploads ({_missing(held)}); install bubblewrap or use "
        "a kernel with Landlock (see `subt-check doctor`), or accept the risk with "
        f"--without-sandbox: {_RISK}"
    )


_RISK = (
    "a package that takes control of its reader can read all files of this user, including uploads "
    "of others"
)


def _missing(layers: Sequence[Layer]) -> str:
    """Return why none of the layers that could hide files does."""
    reasons = [f"{layer.name}: {layer.words}" for layer in layers if layer.name != SECCOMP]
    return plain(
        shortened("; ".join(reasons) or "the process that provides them ends immediately", 300)
    )
