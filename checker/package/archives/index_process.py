"""Reads the index of an untrusted archive: a process in the sandbox.

On its socket comes the name of an archive, one JSON object a message, with a descriptor of the
file; it answers in a line whether the archive can be unpacked, or that the disk fails, and opens
nothing itself.
"""

from __future__ import annotations

import json
import os
import socket
import tempfile
import zipfile
from functools import cache as once
from pathlib import Path

from checker.base.errors import UnreadableInput, momentary_cause
from checker.package.archives.archive import check_archive

MESSAGE_LIMIT = 4_096
"""Bytes."""


@once
def prepare() -> None:
    """Look at an archive of our own: the first look takes ten times as long as those that follow.

    What was done before a process is forked, it need not do.
    """
    with tempfile.TemporaryFile() as file:
        with zipfile.ZipFile(file, "w") as archive:
            archive.writestr("robot/model.sdf", "<sdf/>")
        file.flush()
        _looked_at(file.fileno(), "robot.zip")


def serve(wire: socket.socket) -> None:
    """Answer until the socket closes: the caller sends one request."""
    while True:
        message, descriptors, _, _ = socket.recv_fds(wire, MESSAGE_LIMIT, 1)
        if not message:
            return
        (descriptor,) = descriptors
        try:
            answer = _looked_at(descriptor, json.loads(message)["name"])
        finally:
            os.close(descriptor)
        wire.sendall(json.dumps(answer).encode() + b"\n")


def _looked_at(descriptor: int, name: str) -> dict[str, str]:
    try:
        check_archive(Path(name), name, descriptor=descriptor)
    except UnreadableInput as error:
        if cause := momentary_cause(error):
            return {"momentary": cause}
        return {"reason": error.reason, "advice": error.advice}
    return {}
