"""A user of its own for a process that root starts: to it, all files are those of others."""

from __future__ import annotations

import ctypes
import os
import secrets
import stat
import struct
from collections.abc import Iterable
from pathlib import Path

from checker.base.sandbox.seccomp import NotHeld

_FIRST, _LAST = 61184, 65519
"""User ids that systems leave to services that come and go (systemd: UIDS-GIDS, DynamicUser)."""


def free_account() -> int:
    """Return a user id that hardly any other process has; 0 where this process is not root's."""
    if os.getuid() != 0:
        return 0
    return _FIRST + secrets.randbelow(_LAST - _FIRST + 1)


def become(account: int, needed: Iterable[str], folder: str = "") -> None:
    """Become another user, for good; all rights of root go, whether or not this can be done.

    Args:
        account: Its id, which is also that of its group.
        needed: Files and folders that it has to reach.
        folder: One that is to belong to it; empty for none.

    Raises:
        NotHeld: This process is not root's, or the user could not reach what it needs.
    """
    if os.getuid() != 0 or not account:
        raise NotHeld("it is not started by root")
    try:
        around = (str(Path(folder).parent),) if folder else ()
        for path in (*needed, *around):
            if blocked := _blocked(Path(path)):
                raise NotHeld(f"{blocked} is closed to other users")
        if folder:
            os.chown(folder, account, account)
        os.setgroups([])
        os.setresgid(account, account, account)
        os.setresuid(account, account, account)
    except NotHeld:
        raise
    except OSError as error:
        raise NotHeld(f"the system does not let it change its user ({error.strerror})") from None
    finally:
        give_up_rights()


def give_up_rights() -> None:
    """Give up what root may do and others may not (capabilities(7))."""
    libc = ctypes.CDLL(None, use_errno=True)
    if hasattr(libc, "capset"):
        header = struct.pack("=Ii", _CAPABILITIES, 0)
        libc.capset(ctypes.c_char_p(header), ctypes.c_char_p(bytes(24)))


_CAPABILITIES = 0x20080522
"""_LINUX_CAPABILITY_VERSION_3."""


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
