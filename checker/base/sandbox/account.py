"""A separate user for a process that root starts: all files belong to others."""

from __future__ import annotations

import ctypes
import os
import secrets
import stat
import struct
import sys
from collections.abc import Iterable
from pathlib import Path

from checker.base.sandbox.seccomp import NotHeld

_FIRST, _LAST = 61184, 65519
"""User ids that systems leave to services that come and go (systemd: UIDS-GIDS, DynamicUser)."""


def free_account() -> int:
    """Return a user id that hardly any other process has; 0 if this process is not root's."""
    if sys.platform != "linux" or os.getuid() != 0:
        return 0
    return _FIRST + secrets.randbelow(_LAST - _FIRST + 1)


def switch_user(
    account: int, needed: Iterable[str], folder: str = "", *, read_all: bool = False
) -> str:
    """Permanently become another user; the rights of root go, whether or not this can be done.

    Args:
        account: Its id, which is also that of its group.
        needed: Files and folders that it has to reach.
        folder: One that is to belong to it; empty for none.
        read_all: Whether it may keep the right to read all files if it could not reach what it
            needs: for a process to which Landlock leaves few.

    Returns:
        The folder for which it has kept this right; empty if it has not.

    Raises:
        NotHeld: This process is not root's, or the user could not reach what it needs.
    """
    if sys.platform != "linux" or os.getuid() != 0 or not account:
        raise NotHeld("it is not started by root")
    kept = 0
    try:
        around = (str(Path(folder).parent),) if folder else ()
        blocked = next(filter(None, (_blocked(Path(path)) for path in (*needed, *around))), "")
        if blocked and not (read_all and _permitted() & _DAC_READ_SEARCH):
            raise NotHeld(f"{blocked} is closed to other users")
        if folder:
            os.chown(folder, account, account)
        os.setgroups([])
        os.setresgid(account, account, account)
        if blocked:
            ctypes.CDLL(None).prctl(_PR_SET_KEEPCAPS, 1, 0, 0, 0)
        os.setresuid(account, account, account)
        kept = _DAC_READ_SEARCH if blocked else 0
    except NotHeld:
        raise
    except OSError as error:
        raise NotHeld(f"the system does not let it change its user ({error.strerror})") from None
    finally:
        give_up_rights(kept)
    return blocked


def give_up_rights(kept: int = 0) -> None:
    """Drop the capabilities of root (capabilities(7)).

    Args:
        kept: The capabilities that stay, one bit each; none is gained.
    """
    libc = ctypes.CDLL(None, use_errno=True)
    if hasattr(libc, "capset"):
        libc.capset(_HEADER, struct.pack("=6I", kept, kept, 0, 0, 0, 0))


def _permitted() -> int:
    """Return the rights of root that this process has; a container may leave it a few."""
    data = ctypes.create_string_buffer(24)
    libc = ctypes.CDLL(None, use_errno=True)
    known = hasattr(libc, "capget") and libc.capget(_HEADER, data) == 0
    return int(struct.unpack("=6I", data.raw)[1]) if known else 0


_HEADER = struct.pack("=Ii", 0x20080522, 0)
"""_LINUX_CAPABILITY_VERSION_3, of this process."""
_DAC_READ_SEARCH = 1 << 2
_PR_SET_KEEPCAPS = 8


def _blocked(path: Path) -> str:
    """Return the folder on the way to a path, or the path, that is closed to others; or nothing."""
    for place in (path, *path.absolute().parents):
        try:
            status = place.stat()
        except OSError:
            continue
        wanted = 0o005 if place == path and stat.S_ISDIR(status.st_mode) else 0o001
        if stat.S_ISDIR(status.st_mode) and status.st_mode & wanted != wanted:
            return str(place)
    return ""
