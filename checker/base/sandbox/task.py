"""Work of a process in the sandbox: it calls one function of one module and ends.

The module has `answer(request: bytes, files: Files)`, which returns bytes, or bytes and files (see
`Answer`). Its `prepare()`, if it has one, is called before the request is there.
"""

from __future__ import annotations

import os
import signal
import socket
import sys
from collections.abc import Iterable
from contextlib import suppress
from errno import ENOMEM
from importlib import import_module
from struct import Struct
from types import ModuleType
from typing import Any, BinaryIO

from checker.base.errors import DEBUG, is_momentary
from checker.base.sandbox.files import Content, read, write
from checker.base.sandbox.layers import Sandbox, narrow
from checker.base.sandbox.windows_job import limit_by_job
from checker.base.system import tighten

Answer = bytes | tuple[bytes, Iterable[tuple[str, Content]]]
"""Answer of a process; files are made one by one, while they are written."""
OUT_OF_MEMORY, FAILED, DISTURBED = 71, 70, 75
"""Exit codes, as in sysexits.h: EX_OSERR, EX_SOFTWARE, EX_TEMPFAIL (the disk or the system)."""
_PR_SET_PDEATHSIG = 1
PLACE = Struct("<QQ")
"""Start and end of one of several requests or answers in their common file."""
_REQUEST_LIMIT = 500_000_000
FAULT_LIMIT = 4_000
"""Greatest length of a fault's message, bytes."""
_FILE_BYTES, _OPEN_FILES = 1_000_000_000, 512
INPUT = 0
"""Descriptor of the input: a byte comes when the request is there."""


def run(order: dict[str, Any], sandbox: Sandbox, descriptors: tuple[int, ...]) -> int:
    """Do what was ordered; return the exit code.

    Args:
        order: `module`, `seconds` of processor time, `memory` in bytes, `works` (whether it writes
            into the working folder and requests processes), `draws` and `serves` (whether its
            request is a socket, by which it answers many), and `lasts`.
        sandbox: The sandbox of this process.
        descriptors: The input, on which a byte comes when the request is there; the files of
            request and answer; the socket by which to request processes, or -1; the pipe by which
            to state that an answer is there, or -1.
    """
    input, request, answer, inner, done = descriptors
    try:
        end_with_parent()
        _speak_to_nobody(input)
        os.chdir(sandbox.work if order["works"] and sandbox.work else "/")
        if inner >= 0:
            from checker.base.sandbox.launcher import inherit

            inherit(inner)
        hold_to(order["seconds"], order["memory"])
        narrow(sandbox, works=order["works"], draws=order["draws"])
        module = load_prepared(order["module"])
        if order["serves"]:
            module.serve(socket.socket(fileno=request))
        elif order.get("lasts"):
            _answer_all(module, request, answer, done)
        elif os.read(INPUT, 1):
            _answer_one(module, request, answer)
    except BaseException as error:  # noqa: BLE001 - the caller learns that there is no answer
        return _told(error, answer)
    return 0


def do(order: dict[str, Any], request: int, answer: int) -> int:
    """Answer the request that is there, outside a sandbox; return the exit code.

    Args:
        order: See `run`.
        request: The file of the request.
        answer: The file of the answer.
    """
    try:
        hold_to(order["seconds"], order["memory"])
        _answer_one(load_prepared(order["module"]), request, answer)
    except BaseException as error:  # noqa: BLE001 - the caller learns that there is no answer
        return _told(error, answer)
    return 0


def load_prepared(name: str) -> ModuleType:
    """Return a module that is loaded and, if it can be, prepared."""
    module = import_module(name)
    if hasattr(module, "prepare"):
        module.prepare()
    return module


def code_of(error: BaseException) -> int:
    """Return the exit code of a process that ends with an error."""
    if isinstance(error, MemoryError) or (isinstance(error, OSError) and error.errno == ENOMEM):
        return OUT_OF_MEMORY
    return DISTURBED if is_momentary(error) else FAILED


def _answer_one(module: ModuleType, request: int, answer: int) -> None:
    message, files = read(request, _REQUEST_LIMIT)
    with os.fdopen(os.dup(answer), "wb") as file:
        _write(file, module.answer(message, files))


def _answer_all(module: ModuleType, request: int, answer: int, done: int) -> None:
    """Answer one request after the other (see `checker.base.child_server`)."""
    with os.fdopen(os.dup(answer), "wb") as file:
        while len(place := os.read(INPUT, PLACE.size)) == PLACE.size:
            message, files = read(request, _REQUEST_LIMIT, *PLACE.unpack(place))
            start = file.tell()
            _write(file, module.answer(message, files))
            os.write(done, PLACE.pack(start, file.tell()))


def _told(error: BaseException, answer: int) -> int:
    """Return the exit code of an error; leave what went wrong in place of an answer, for a log."""
    code = code_of(error)
    if code != OUT_OF_MEMORY:
        _tell_fault(answer)
    return code


def _tell_fault(answer: int) -> None:
    import traceback

    words = traceback.format_exc()
    if os.environ.get(DEBUG):
        sys.stderr.write(words)
    with suppress(OSError), open(answer, "wb") as file:
        file.truncate(0)
        file.seek(0)
        write(file, words.encode(errors="replace")[-FAULT_LIMIT:])


def _write(file: BinaryIO, answer: Answer) -> None:
    if isinstance(answer, bytes):
        write(file, answer)
    else:
        write(file, *answer)


def _speak_to_nobody(input: int) -> None:
    """Lead what libraries print nowhere; the input becomes the standard input."""
    os.dup2(input, INPUT)
    os.close(input)
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in (1,) if os.environ.get(DEBUG) else (1, 2):
        os.dup2(nowhere, stream)
    os.close(nowhere)


def end_with_parent() -> None:
    """Kill this process when its parent ends, where the system can (Linux: prctl)."""
    if sys.platform != "linux":
        return
    import ctypes

    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def hold_to(seconds: int, memory: int) -> None:
    """Take from this process what it must not use; no limit that it has already is raised."""
    if sys.platform == "win32":
        limit_by_job(seconds, memory)
        return
    tighten("RLIMIT_CPU", max(seconds, 1), max(seconds, 1) + 1)
    tighten("RLIMIT_AS", memory, memory)
    hold_files_to(_FILE_BYTES, _OPEN_FILES)


def hold_files_to(file_bytes: int, open_files: int) -> None:
    """Take from this process larger files, more open ones at a time, and all core dumps."""
    for name, most in (
        ("RLIMIT_FSIZE", file_bytes),
        ("RLIMIT_NOFILE", open_files),
        ("RLIMIT_CORE", 0),
    ):
        tighten(name, most, most)
