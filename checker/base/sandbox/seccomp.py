"""A filter of system calls: calls that are forbidden for this process.

Forbidden are the calls that reach other processes, other machines and other programs, and those
by which holes in the kernel are usually reached; all others are left. A forbidden call fails with
EPERM, so that a library that only tries it continues. See seccomp(2).
"""

from __future__ import annotations

import ctypes
import os
import platform
import struct
import sys
from collections.abc import Iterable, Iterator, Mapping
from functools import cache as once

from checker.base.record import Record
from checker.base.resources import table

_32_BITS = 2**32
_ARCHITECTURES = table("system_calls")["architectures"]
"""Read before a process may open no more files."""


class Architecture(Record):
    """Calling convention of the kernel on one kind of processor.

    Attributes:
        audit: Its AUDIT_ARCH number, which a filter of system calls receives.
        foreign: Least number of calls by another convention (x32); 0 if there is none.
        calls: Number of each call by its name; None if it has no such call.
    """

    audit: int
    foreign: int
    calls: Mapping[str, int | None]


def architecture() -> Architecture | None:
    """Return that of this process; None if its calls are not known."""
    known = _ARCHITECTURES.get(platform.machine())
    return Architecture(**known) if known and sys.maxsize > _32_BITS else None


FORBIDDEN = (
    # Other machines, and other processes of this one.
    *("socket", "socketpair", "connect", "accept", "accept4", "bind", "listen"),
    *("ptrace", "process_vm_readv", "process_vm_writev", "kcmp", "pidfd_getfd"),
    *("process_madvise", "process_mrelease", "pidfd_send_signal", "rt_sigqueueinfo"),
    *("rt_tgsigqueueinfo", "setpriority", "ioprio_set", "mq_open", "mq_unlink"),
    # By number as well: a guessed number needs no name.
    *("msgctl", "msgget", "msgrcv", "msgsnd", "semctl", "semget", "semop", "semtimedop"),
    *("shmat", "shmctl", "shmget"),
    # Other programs, and files by other names.
    *("execve", "execveat", "link", "linkat", "symlink", "symlinkat", "mknod", "mknodat"),
    *("name_to_handle_at", "open_by_handle_at", "inotify_add_watch"),
    # Another view of the system.
    *("mount", "umount2", "pivot_root", "chroot", "move_mount", "open_tree", "open_tree_attr"),
    *("fsopen", "fsconfig", "fsmount", "fspick", "mount_setattr", "unshare", "setns"),
    # What only administrators and debuggers need.
    *("add_key", "keyctl", "request_key", "io_uring_setup", "io_uring_enter"),
    *("io_uring_register", "bpf", "perf_event_open", "userfaultfd", "fanotify_init"),
    *("acct", "adjtimex", "clock_adjtime", "clock_settime", "settimeofday", "delete_module"),
    *("finit_module", "init_module", "ioperm", "iopl", "kexec_file_load", "kexec_load"),
    *("quotactl", "reboot", "setdomainname", "sethostname", "swapoff", "swapon", "syslog"),
    *("vhangup", "migrate_pages", "move_pages"),
    # What is said of files: Landlock knows nothing of modes, owners, times and attributes.
    *("chmod", "fchmod", "fchmodat", "fchmodat2", "chown", "fchown", "lchown", "fchownat"),
    *("utime", "utimes", "futimesat", "utimensat", "setxattr", "fsetxattr", "lsetxattr"),
    *("setxattrat", "removexattr", "fremovexattr", "lremovexattr", "removexattrat"),
    "file_setattr",
)
"""Calls that fail, whatever their arguments."""
_OPENING = ("open", "openat", "openat2", "creat", "memfd_create")
_CHANGING = (
    *("truncate", "rename", "renameat", "renameat2", "unlink", "unlinkat", "mkdir", "mkdirat"),
    "rmdir",
)
"""Calls that change files by their names."""
_LEAVING = ("setpgid", "setsid")
"""Calls by which a process leaves the group that is ended at once. In its own session, each
would also have as much of the processors as all of another one (sched(7))."""
_OWN_PROCESS_ONLY = {
    "prlimit64": 0,
    "sched_setaffinity": 0,
    "sched_setattr": 0,
    "sched_setparam": 0,
    "sched_setscheduler": 0,
}
"""Calls about any process, and which argument states whose: 0 is the caller."""
_SIGNALS = ("kill", "tkill", "tgkill")
_NEW_NAMESPACES = 0x7E020080
"""Flags of clone(2): CLONE_NEWNS, CGROUP, UTS, IPC, USER, PID, NET and TIME."""
_IOCTLS = (0x5412, 0x541C, 0x8901, 0x8902)
"""Requests of ioctl(2) that type into a terminal (TIOCSTI, TIOCLINUX), or have another process
sent signals (FIOSETOWN, SIOCSPGRP)."""
_FCNTLS = (8, 15, 1024, 1026)
"""Commands of fcntl(2) that send signals to another process, lock a file, or watch a
folder: F_SETOWN, F_SETOWN_EX, F_SETLEASE, F_NOTIFY."""

_LOAD, _EQUAL, _AT_LEAST, _ANY_BIT, _RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
"""Operations of a filter: BPF_LD|W|ABS, BPF_JMP|JEQ|K, JGE, JSET, BPF_RET|K."""
_ALLOW, _ERROR, _KILL = 0x7FFF0000, 0x00050000, 0x80000000
_EPERM, _ENOSYS = 1, 38
_NUMBER, _ARCH, _ARGUMENTS = 0, 4, 16
"""Offsets within `struct seccomp_data`; each argument has 8 bytes, the lower 4 first."""
_PR_SET_NO_NEW_PRIVS, _PR_SET_SECCOMP, _MODE_FILTER = 38, 22, 2

Step = tuple[int, int, int, int]
"""One instruction: operation, steps to skip if true, if false, constant."""


class NotHeld(OSError):
    """The kernel does not apply a layer; the text states why."""


class _Program(ctypes.Structure):
    _fields_ = (("length", ctypes.c_ushort), ("filter", ctypes.c_void_p))


def gain_nothing() -> None:
    """Prevent programs that this process starts from gaining rights, such as by setuid (prctl(2)).

    Raises:
        NotHeld: The system is not Linux.
    """
    libc = _libc()
    if libc.prctl(_PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0:
        raise NotHeld(os.strerror(ctypes.get_errno()))


def forbid_calls(*, opens: bool = True, changes: bool = True, signals: bool = True) -> None:
    """Permanently forbid this process, and all that it starts, the calls of `FORBIDDEN`.

    Args:
        opens: Whether it may still open files.
        changes: Whether it may still remove and rename files, and make folders.
        signals: Whether it may still send signals to other processes.

    Raises:
        NotHeld: The kernel has no filters, or the processor is not known.
    """
    machine = _machine()
    also = (*(() if opens else _OPENING), *(() if changes else _CHANGING))
    _hold(
        machine,
        [
            *_refused(machine, (*FORBIDDEN, *also)),
            *_process_steps(machine, signals),
            *_partly(machine),
        ],
    )


def forbid_others(*, changes: bool = True) -> None:
    """Permanently isolate a process that `forbid_calls` already restricts.

    To build that filter again takes a new process as long as to be forked.

    Args:
        changes: The changes, as for `forbid_calls`.

    Raises:
        NotHeld: As by `forbid_calls`.
    """
    machine = _machine()
    also = () if changes else _CHANGING
    _hold(machine, [*_refused(machine, also), *_process_steps(machine, signals=False)])


def _machine() -> Architecture:
    machine = architecture()
    if machine is None:
        raise NotHeld("the system calls of this processor are not known")
    return machine


def _hold(machine: Architecture, steps: Iterable[Step]) -> None:
    """Make the kernel run these steps at each call, and allow calls that no step decides."""
    begin: list[Step] = [
        (_LOAD, 0, 0, _ARCH),
        (_EQUAL, 1, 0, machine.audit),
        (_RETURN, 0, 0, _KILL),
        (_LOAD, 0, 0, _NUMBER),
    ]
    if machine.foreign:
        begin += [(_AT_LEAST, 0, 1, machine.foreign), (_RETURN, 0, 0, _KILL)]
    _install(b"".join(_packed((*begin, *steps, (_RETURN, 0, 0, _ALLOW)))))


def _refused(machine: Architecture, names: Iterable[str]) -> Iterator[Step]:
    """Yield the steps that refuse calls, whatever their arguments."""
    for name in names:
        yield from _call_steps(name, machine, [(_RETURN, 0, 0, _ERROR | _EPERM)])


def _partly(machine: Architecture) -> Iterator[Step]:
    """Yield the steps that refuse calls with some arguments."""
    # glibc goes back to clone(2), whose flags can be looked at.
    yield from _call_steps("clone3", machine, [(_RETURN, 0, 0, _ERROR | _ENOSYS)])
    yield from _call_steps("clone", machine, _refused_if(_ANY_BIT, 0, (_NEW_NAMESPACES,)))
    yield from _call_steps("ioctl", machine, _refused_if(_EQUAL, 1, _IOCTLS))
    yield from _call_steps("fcntl", machine, _refused_if(_EQUAL, 1, _FCNTLS))


def _process_steps(machine: Architecture, signals: bool) -> Iterator[Step]:
    """Yield the steps that refuse calls about other processes.

    Without signals, a process can also not leave the group that the launcher has put it into.
    """
    own = os.getpid()
    for name, argument in _OWN_PROCESS_ONLY.items():
        yield from _call_steps(name, machine, _refused_unless(argument, (0, own)))
    if not signals:
        yield from _refused(machine, _LEAVING)
    for name in () if signals else _SIGNALS:
        yield from _call_steps(name, machine, _refused_unless(0, (own,)))


def _call_steps(name: str, machine: Architecture, then: list[Step]) -> list[Step]:
    """Return the steps that do something about one call."""
    number = machine.calls[name]
    return [] if number is None else [(_EQUAL, 0, len(then), number), *then]


def _refused_if(test: int, argument: int, values: Iterable[int]) -> list[Step]:
    """Return steps that end in a refusal if an argument is one of the values, else in leave."""
    tests = [[(test, 0, 1, value), (_RETURN, 0, 0, _ERROR | _EPERM)] for value in values]
    load = (_LOAD, 0, 0, _ARGUMENTS + 8 * argument)
    return [load, *(step for pair in tests for step in pair), (_RETURN, 0, 0, _ALLOW)]


def _refused_unless(argument: int, values: Iterable[int]) -> list[Step]:
    """Return steps that end in leave if an argument is one of the values, else in a refusal."""
    tests = [[(_EQUAL, 0, 1, value), (_RETURN, 0, 0, _ALLOW)] for value in values]
    load = (_LOAD, 0, 0, _ARGUMENTS + 8 * argument)
    return [load, *(step for pair in tests for step in pair), (_RETURN, 0, 0, _ERROR | _EPERM)]


def _packed(steps: Iterable[Step]) -> Iterator[bytes]:
    for operation, true, false, constant in steps:
        yield struct.pack("<HBBI", operation, true, false, constant)


def _install(code: bytes) -> None:
    buffer = ctypes.create_string_buffer(code, len(code))
    filter = _Program(len(code) // 8, ctypes.cast(buffer, ctypes.c_void_p).value)
    if _libc().prctl(_PR_SET_SECCOMP, _MODE_FILTER, ctypes.byref(filter), 0, 0) != 0:
        raise NotHeld(f"the kernel filters no system calls ({os.strerror(ctypes.get_errno())})")


@once
def _libc() -> ctypes.CDLL:
    libc = ctypes.CDLL(None, use_errno=True)
    if not hasattr(libc, "prctl"):
        raise NotHeld("the system is not Linux")
    return libc
