"""The sandbox of a process: its layers, and those that are active on this machine.

Each is independent of the others; docs/security.md describes what each protects.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress

from checker.base.record import Record
from checker.base.sandbox import account, landlock, namespaces, program_files, seccomp
from checker.base.sandbox.seccomp import NotHeld

NAMESPACES, ACCOUNT, LANDLOCK, SECCOMP = "namespaces", "account", "landlock", "seccomp"
ALL = (NAMESPACES, ACCOUNT, LANDLOCK, SECCOMP)


class Layer(Record):
    """One layer of the sandbox.

    Attributes:
        name: One of `ALL`.
        held: Whether it is active.
        words: How it is active, or why not; the end of a sentence.
        hides: Whether it keeps files of others out of reach.
    """

    name: str
    held: bool
    words: str
    hides: bool = False


class Sandbox(Record):
    """Sandbox to set up around a process.

    Attributes:
        names: The layers, of `ALL`; a selection is for tests of single layers.
        wrapped: Whether bubblewrap has made the namespaces already.
        account: User id to take; 0 to stay the same.
        work: Folder that it may write in; empty for none.
        read: Files and folders of the program, absolute.
    """

    names: tuple[str, ...] = ALL
    wrapped: bool = False
    account: int = 0
    work: str = ""
    read: tuple[str, ...] = ()


def enter(sandbox: Sandbox) -> list[Layer]:
    """Permanently put this process and all that it will start in a sandbox.

    Those that the system does not have are left out, and the result states it.
    """
    return [_entered(name, sandbox) for name in ALL if name in sandbox.names]


def _entered(name: str, sandbox: Sandbox) -> Layer:
    try:
        return _WAYS[name](sandbox)
    except NotHeld as error:
        return Layer(name, False, str(error.args[-1]))


def hides_files(layers: Iterable[Layer]) -> bool:
    """Return whether a compromised process cannot reach the files of the user."""
    return any(layer.held and layer.hides for layer in layers)


def _namespaces(sandbox: Sandbox) -> Layer:
    if sandbox.wrapped:
        words = "bubblewrap: no network, no other processes, no other files"
        return Layer(NAMESPACES, True, words, hides=True)
    namespaces.leave_network()
    return Layer(NAMESPACES, True, "no network; bubblewrap would hide other processes and files")


def _account(sandbox: Sandbox) -> Layer:
    limited = LANDLOCK in sandbox.names and landlock.version() > 0
    blocked = account.switch_user(sandbox.account, sandbox.read, sandbox.work, read_all=limited)
    but = f"; it may read all files that Landlock leaves, as {blocked} is closed to other users"
    return Layer(ACCOUNT, True, f"user {sandbox.account}{but if blocked else ''}", not blocked)


def _landlock(sandbox: Sandbox) -> Layer:
    seccomp.gain_nothing()
    version = _allow_files(sandbox, works=True, draws=True)
    return Layer(LANDLOCK, True, f"version {version}", hides=True)


def _allow_files(sandbox: Sandbox, *, works: bool, draws: bool) -> int:
    """Leave this process the files of the program and what it needs besides; see `narrow`."""
    return landlock.allow_only(
        read=(*sandbox.read, *program_files.MACHINE),
        work=(sandbox.work,) if works and sandbox.work else (),
        devices=(*program_files.DEVICES, *(program_files.SCREENS if draws else ())),
    )


def _seccomp(sandbox: Sandbox) -> Layer:
    seccomp.gain_nothing()
    seccomp.forbid_calls(changes=bool(sandbox.work))
    return Layer(SECCOMP, True, f"{len(seccomp.FORBIDDEN)} system calls are forbidden")


_WAYS = {
    NAMESPACES: _namespaces,
    ACCOUNT: _account,
    LANDLOCK: _landlock,
    SECCOMP: _seccomp,
}


def narrow(sandbox: Sandbox, *, works: bool, draws: bool) -> None:
    """Take from a process in the sandbox what its own task does not need.

    Args:
        sandbox: Its own.
        works: Whether it may write into the working folder.
        draws: Whether it may use graphics cards.
    """
    # What cannot be narrowed stays in the sandbox that there is.
    if LANDLOCK in sandbox.names:
        # Even if it takes nothing, it keeps the process from its launcher: a domain of its own.
        with suppress(NotHeld):
            _allow_files(sandbox, works=works, draws=draws)
    if SECCOMP in sandbox.names:
        with suppress(NotHeld):
            # Without a folder to work in, the launcher has forbidden changes already.
            seccomp.forbid_others(changes=works or not sandbox.work)
