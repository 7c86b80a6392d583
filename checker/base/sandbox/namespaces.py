"""Another view of the system: without network, other processes, or files of others.

Bubblewrap (bwrap) makes it where it is installed. Without it, a process can leave the network and
what processes share by itself, but still sees files and processes: see namespaces(7).
"""

from __future__ import annotations

import ctypes
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterable, Sequence
from contextlib import suppress
from functools import cache as once
from pathlib import Path

from checker.base.sandbox.account import give_up_rights
from checker.base.sandbox.program_files import program_paths
from checker.base.sandbox.seccomp import NotHeld

WORK = "/subt-check-work"
"""Path at which a process finds the folder that it may write to."""
_USER, _UTS, _IPC, _NET = 0x10000000, 0x04000000, 0x08000000, 0x40000000
"""Flags of unshare(2): CLONE_NEWUSER and so on."""
_LINKS = ("/bin", "/lib", "/lib32", "/lib64")
_TRY_SECONDS = 60


def sandboxed_command(command: Sequence[str], read: Iterable[str], work: str = "") -> list[str]:
    """Return the command that runs a command where only some files can be seen.

    Args:
        command: Program and arguments.
        read: Files and folders that it sees, at their own paths.
        work: Folder that it sees as `WORK` and may write in; empty for an empty one in memory.
    """
    paths = list(read)
    # Made on the way to a file, they would be closed to all but root.
    parents = (parent for path in paths for parent in reversed(Path(path).parents))
    folders = dict.fromkeys(parent for parent in parents if str(parent) not in _LINKS)
    shown = [word for folder in folders if folder.name for word in ("--dir", str(folder))]
    shown += [word for path in paths for word in _mount_options(path)]
    place = ("--bind", work, WORK) if work else ("--tmpfs", WORK)
    return [*_BWRAP, *_rights(), *_OWN, *shown, *place, "--chdir", "/", "--", *command]


_BWRAP = (
    *("bwrap", "--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts"),
    # As the first process of its view, it takes all others with it when it ends: bubblewrap's own
    # first process would wait for them, however long they run.
    *("--unshare-cgroup-try", "--new-session", "--as-pid-1"),
)
_OWN = (
    *("--dev", "/dev", "--dev-bind-try", "/dev/dri", "/dev/dri"),
    *("--proc", "/proc", "--tmpfs", "/tmp"),  # noqa: S108 - its own, in memory
)


def _rights() -> tuple[str, ...]:
    if sys.platform == "linux" and os.getuid() == 0:
        # It becomes another user itself, after Python has started.
        added = ("CAP_SETUID", "CAP_SETGID", "CAP_CHOWN")
        return ("--cap-drop", "ALL", *(word for name in added for word in ("--cap-add", name)))
    return ("--unshare-user", "--cap-drop", "ALL")


def _mount_options(path: str) -> tuple[str, ...]:
    if path in _LINKS and os.path.islink(path):  # noqa: PTH114 - where they are parts of /usr
        return ("--symlink", os.readlink(path), path)  # noqa: PTH115
    return ("--ro-bind-try", path, path)


@once
def bubblewrap() -> str:
    """Return why bubblewrap cannot be used here; empty if it is."""
    if shutil.which("bwrap") is None:
        return "bubblewrap (bwrap) is not installed"
    command = sandboxed_command(["/usr/bin/true"], program_paths())
    try:
        tried = subprocess.run(  # noqa: S603 - a fixed command
            command, capture_output=True, timeout=_TRY_SECONDS, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return f"bubblewrap does not start: {error}"
    words = tried.stderr.decode(errors="replace").strip()[:200]
    return "" if tried.returncode == 0 else f"bubblewrap fails: {words or tried.returncode}"


def end(wrapper: int) -> None:
    """End all that bubblewrap has started, though what it runs hangs; it would outlive bubblewrap.

    Args:
        wrapper: Its process, which has not ended.
    """
    if sys.platform != "linux":
        return
    with suppress(OSError):
        started = Path(f"/proc/{wrapper}/task/{wrapper}/children").read_text("ascii")
        for word in started.split():
            os.kill(int(word), signal.SIGKILL)


def leave_network() -> None:
    """Leave the network, and the memory and names that processes share.

    Call it before a library starts threads: a process of several threads cannot become another
    user, which Linux requires of all but root (unshare(2)).

    Raises:
        NotHeld: The system, or a container, does not allow it.
    """
    if sys.platform != "linux":
        raise NotHeld("only Linux has namespaces")
    user, group = os.getuid(), os.getgid()
    flags = _UTS | _IPC | _NET | (0 if user == 0 else _USER)
    libc = ctypes.CDLL(None, use_errno=True)
    if not hasattr(libc, "unshare"):
        raise NotHeld("the system does not support namespaces")
    if libc.unshare(flags) != 0:
        raise NotHeld(f"the system does not allow namespaces ({os.strerror(ctypes.get_errno())})")
    if flags & _USER:
        # In its own namespace it would be the user `nobody`.
        with suppress(OSError):
            _be_known_as(user, group)
        # In its own view it would have all rights.
        give_up_rights()


def _be_known_as(user: int, group: int) -> None:
    for name, text in (
        ("setgroups", "deny"),
        ("uid_map", f"{user} {user} 1"),
        ("gid_map", f"{group} {group} 1"),
    ):
        # In one write, as the system wants it.
        descriptor = os.open(f"/proc/self/{name}", os.O_WRONLY)
        try:
            os.write(descriptor, text.encode())
        finally:
            os.close(descriptor)
