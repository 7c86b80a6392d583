"""Landlock: limits the files that this process can reach, without special permissions.

See landlock(7) and Documentation/userspace-api/landlock.rst. Access that is not granted is denied
to this process and all that it starts, permanently and for every user.
"""

from __future__ import annotations

import ctypes
import os
import stat
import struct
import sys
from collections.abc import Iterable
from contextlib import suppress
from functools import cache as once

from checker.base.sandbox.seccomp import NotHeld

_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
"""Numbers of system calls; the same on all architectures."""
_VERSION_FLAG, _PATH_BENEATH = 1, 1

_EXECUTE, _WRITE, _READ, _LIST = 1 << 0, 1 << 1, 1 << 2, 1 << 3
_REMOVE_DIR, _REMOVE_FILE, _MAKE_DIR, _MAKE_FILE = 1 << 4, 1 << 5, 1 << 7, 1 << 8
_REFER, _TRUNCATE, _DEVICE = 1 << 13, 1 << 14, 1 << 15
_FIRST = (1 << 13) - 1
"""Access rights of the first version of Landlock; each later version adds a right or a scope."""
_SINCE = {2: _REFER, 3: _TRUNCATE, 5: _DEVICE}
_NETWORK_SINCE, _BIND_AND_CONNECT = 4, 3
_SCOPES_SINCE, _SOCKETS_AND_SIGNALS = 6, 3

_OF_FILES = _EXECUTE | _WRITE | _READ | _TRUNCATE | _DEVICE
_TO_READ = _READ | _LIST
_TO_WORK = (
    *(_READ, _LIST, _WRITE, _TRUNCATE, _REFER),
    *(_REMOVE_DIR, _REMOVE_FILE, _MAKE_DIR, _MAKE_FILE),
)
"""In its own folder: neither links nor devices, sockets or pipes, and no programs."""
_TO_DRAW = _READ | _LIST | _WRITE | _DEVICE


def version() -> int:
    """Return the version that the kernel has; 0 for none."""
    # On other systems the numbers below are those of other calls.
    if sys.platform != "linux":
        return 0
    with suppress(OSError, AttributeError):
        return max(0, _call(_CREATE_RULESET, None, 0, _VERSION_FLAG))
    return 0


def allow_only(read: Iterable[str], work: Iterable[str] = (), devices: Iterable[str] = ()) -> int:
    """Leave this process the files below some paths; what does not exist is ignored.

    It can no longer bind or connect TCP sockets (version 4), nor reach processes outside by
    signals or abstract sockets (version 6).

    Args:
        read: Files and folders to read.
        work: Folders to read and write in.
        devices: Devices to read and write.

    Returns:
        The version of Landlock.

    Raises:
        NotHeld: The kernel has no Landlock, or refuses.
    """
    known = version()
    if not known:
        raise NotHeld("the kernel has no Landlock")
    rights = _rights(known)
    ruleset = _call(_CREATE_RULESET, *_ruleset(known), 0)
    try:
        for paths, granted in ((read, _TO_READ), (work, sum(_TO_WORK)), (devices, _TO_DRAW)):
            for path in paths:
                _grant(ruleset, path, granted & rights)
        _call(_RESTRICT_SELF, ruleset, 0)
    finally:
        os.close(ruleset)
    return known


def _rights(known: int) -> int:
    return _FIRST | sum(right for since, right in _SINCE.items() if known >= since)


def _ruleset(known: int) -> tuple[ctypes.Array[ctypes.c_char], int]:
    """Return the attributes of a ruleset and their size."""
    values = [_rights(known)]
    if known >= _NETWORK_SINCE:
        values.append(_BIND_AND_CONNECT)
    if known >= _SCOPES_SINCE:
        values.append(_SOCKETS_AND_SIGNALS)
    data = struct.pack(f"={len(values)}Q", *values)
    return ctypes.create_string_buffer(data, len(data)), len(data)


def _grant(ruleset: int, path: str, rights: int) -> None:
    if sys.platform != "linux":
        return
    try:
        place = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except OSError:
        return
    try:
        if not stat.S_ISDIR(os.fstat(place).st_mode):
            rights &= _OF_FILES
        data = struct.pack("=Qi", rights, place)
        _call(_ADD_RULE, ruleset, _PATH_BENEATH, ctypes.create_string_buffer(data, len(data)), 0)
    finally:
        os.close(place)


def _call(*arguments: object) -> int:
    numbers = [
        ctypes.c_long(argument) if isinstance(argument, int) else argument for argument in arguments
    ]
    result = int(_libc().syscall(*numbers))
    if result < 0:
        raise NotHeld(f"Landlock: {os.strerror(ctypes.get_errno())}")
    return result


@once
def _libc() -> ctypes.CDLL:
    """Return the C library; each process in the sandbox calls it forty times before it begins."""
    libc = ctypes.CDLL(None, use_errno=True)
    libc.syscall.restype = ctypes.c_long
    return libc
