"""A user of its own for a process that root starts: to it, all files are those of others."""

from __future__ import annotations

import os
import secrets
import stat
from collections.abc import Iterable
from pathlib import Path

from checker.sandbox.seccomp import NotHeld

_FIRST, _LAST = 61184, 65519
"""User ids that systems leave to services that come and go (systemd: UIDS-GIDS, DynamicUser)."""


def free_account() -> int:
    """Return a user id that hardly any other process has; 0 where this process is not root's."""
    if os.getuid() != 0:
        return 0
    return _FIRST + secrets.randbelow(_LAST - _FIRST + 1)


def become(account: int, needed: Iterable[str]) -> None:
    """Become another user, for good.

    Args:
        account: Its id, which is also that of its group.
        needed: Files and folders that it has to reach.

    Raises:
        NotHeld: This process is not root's, or the user could not reach what it needs.
    """
    if os.getuid() != 0 or not account:
        raise NotHeld("it is not started by root")
    for path in needed:
        if blocked := _blocked(Path(path)):
            raise NotHeld(f"{blocked} is closed to other users")
    try:
        os.setgroups([])
        os.setresgid(account, account, account)
        os.setresuid(account, account, account)
    except OSError as error:
        raise NotHeld(f"the system lets it become no other user ({error.strerror})") from None


def _blocked(path: Path) -> str:
    """Return the folder on the way to a path, or the path, that is closed to others; or nothing."""
    for place in (path, *path.absolute().parents):
        try:
            found = place.stat()
        except OSError:
            continue
        wanted = 0o005 if place == path and stat.S_ISDIR(found.st_mode) else 0o001
        if stat.S_ISDIR(found.st_mode) and found.st_mode & wanted != wanted:
            return str(place)
    return ""


def account_for(folder: Path) -> int:
    """Return a user id to whom a folder belongs from now on; 0 where there is none to be had."""
    account = free_account()
    try:
        if account:
            # Root's group stays, for a process that does not become that user: it has no rights.
            folder.chmod(0o770)
            os.chown(folder, account, -1)
    except OSError:  # root without its rights, in a container
        return 0
    return account
