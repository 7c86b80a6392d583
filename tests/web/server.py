"""The application behind a real server, and what a test does to it below HTTP."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic, sleep

import uvicorn
from fastapi import FastAPI

from checker.service.processes.child import Connection
from checker.service.store.store import Store

BOUNDARY = "limit-of-parts"


@contextmanager
def served(app: FastAPI) -> Iterator[int]:
    """Serve an application on a free port of this machine, and yield the port."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        config = uvicorn.Config(
            app, http=Connection, ws="none", log_config=None, timeout_graceful_shutdown=1
        )
        server = uvicorn.Server(config)
        thread = threading.Thread(target=server.run, args=([listening],), daemon=True)
        thread.start()
        try:
            yield listening.getsockname()[1]
        finally:
            server.should_exit = True
            thread.join(20)


def form(name: str, content: bytes, fields: dict[str, str] | None = None) -> bytes:
    """Return an upload form as browsers write it, the file last."""
    parts = [
        f'--{BOUNDARY}\r\nContent-Disposition: form-data; name="{field}"\r\n\r\n{text}\r\n'.encode()
        for field, text in (fields or {}).items()
    ]
    head = f'Content-Disposition: form-data; name="file"; filename="{name}"'
    parts += [f"--{BOUNDARY}\r\n{head}\r\n\r\n".encode(), content]
    return b"".join(parts) + f"\r\n--{BOUNDARY}--\r\n".encode()


def request_head(length: int) -> bytes:
    """Return the head of an upload of so many bytes."""
    return (
        "POST /api/checks HTTP/1.1\r\nHost: localhost\r\n"
        f"Content-Type: multipart/form-data; boundary={BOUNDARY}\r\n"
        f"Content-Length: {length}\r\n\r\n"
    ).encode()


def left_behind(store: Store) -> list[Path]:
    """Return all files in the store but its lock."""
    return [each for each in store.folder.rglob("*") if each.is_file() and each.name != "lock"]


def eventually(holds: Callable[[], bool], seconds: float = 90.0) -> bool:
    """Whether something holds after a while: a server notices what happens a moment later."""
    end = monotonic() + seconds
    while not holds() and monotonic() < end:
        sleep(0.02)
    return holds()
