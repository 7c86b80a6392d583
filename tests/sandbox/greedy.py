"""What a process that works does to the launcher, which starts others for it: module `greedy`."""

from __future__ import annotations

import json
import os
import signal
import socket
import time
from contextlib import suppress

from attempts import kind_of, tried

from checker.base.sandbox.files import Files

_ORDER = {"module": "os", "seconds": 1, "memory": 1_000_000_000, "works": False, "draws": False}


def _launcher() -> socket.socket:
    """Return the socket by which this process asks for others: the only one that it has."""
    number = next(number for number in range(1024) if kind_of(number) == "socket")
    return socket.socket(fileno=os.dup(number))


def _send(message: bytes, code: int = 0) -> None:
    # It breaks where the launcher has ended of it.
    with _launcher() as launcher, suppress(OSError):
        socket.send_fds(launcher, [message], [os.dup(1), os.dup(1), os.dup(1), code or 1])


def _full_pipe() -> None:
    """Have it tell an exit code where nobody reads."""
    read, write = os.pipe()
    os.set_blocking(write, False)
    with suppress(BlockingIOError):
        while True:
            os.write(write, bytes(65536))
    with suppress(BlockingIOError):
        while True:
            os.write(write, b"x")
    os.set_blocking(write, True)
    for _ in range(3):
        _send(json.dumps(_ORDER).encode(), write)
    # Without a reader, the pipe would break, not be full.
    if os.fork() == 0:
        with suppress(OSError):
            os.setsid()
        time.sleep(30 + read)
        os._exit(0)


def _nonsense() -> None:
    for message in (b"{", *[b"[]"] * 10, b"x" * 5000, json.dumps({"module": 1}).encode()):
        _send(message)
        time.sleep(0.02)  # else the launcher may read several at once


def _no_descriptors() -> None:
    with _launcher() as launcher, suppress(OSError):
        for _ in range(100):
            launcher.sendall(b"x" * 100)


def _stopped() -> None:
    with suppress(OSError):
        os.kill(os.getppid(), signal.SIGSTOP)


def _greedy_orders() -> None:
    order = _ORDER | {"memory": 2**60, "seconds": 2**30, "works": True, "module": "hostile"}
    _send(json.dumps(order).encode())


DEEDS = {
    deed.__name__.strip("_"): deed
    for deed in (_full_pipe, _nonsense, _no_descriptors, _stopped, _greedy_orders)
}


def answer(request: bytes, _files: Files) -> bytes:
    """Leave a process behind that is hard to end, then trouble the launcher."""
    asked = json.loads(request)
    said = tried("outlive", asked["assets"])
    DEEDS[asked["deed"]]()
    time.sleep(0.5)
    return said.encode()
