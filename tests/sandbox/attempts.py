"""Native code against all that lies outside: what a process does that was taken over.

Each attempt is a function that is given what the test has laid out (see `tests.sandbox.assets`).
It returns a word about what it got, or raises what the system answered. Calls that would harm the
machine are made with arguments that do nothing; they count as got when the kernel looks at them.
This module is loaded in the sandbox as `attempts`; it imports what such a process could have.
"""

# ruff: noqa: PTH101, PTH104, PTH108, PTH123, PTH208, PTH211, S103
# The calls of the system are made as they are.

from __future__ import annotations

import ctypes
import errno
import mmap
import os
import resource
import select
import signal
import socket
import stat
import struct
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from checker.base.sandbox.seccomp import architecture

Assets = dict[str, Any]
ATTEMPTS: dict[str, Callable[[Assets], object]] = {}
LIBC = ctypes.CDLL(None, use_errno=True)
LIBC.syscall.restype = ctypes.c_long
_SECONDS = 5
_REFUSALS = (errno.EPERM, errno.EACCES, errno.ENOSYS)
_X32 = 0x40000000
_INT_80 = b"\xb8\x14\x00\x00\x00\xcd\x80\xc3"
"""mov eax, 20 (getpid of 32-bit programs); int 0x80; ret."""


def attempt(function: Callable[[Assets], object]) -> Callable[[Assets], object]:
    ATTEMPTS[function.__name__] = function
    return function


def tried(name: str, assets: Assets, first: Callable[[], object] = lambda: None) -> str:
    """Make one attempt in a fork, which it may kill.

    Args:
        name: Of the attempt.
        assets: What it is told of the outside.
        first: Called in the fork before it.

    Returns:
        What came of it, "got …" where it came to something.
    """
    read, write = os.pipe()
    id = os.fork()
    if id == 0:
        # Come what may, the fork does not go on as its parent.
        try:
            os.close(read)
            signal.alarm(_SECONDS)
            os.write(write, _told(name, assets, first).encode(errors="replace")[:4000])
        finally:
            os._exit(0)
    os.close(write)
    with os.fdopen(read, "rb") as pipe:
        # Not until its end: what the attempt leaves behind may hold the pipe open.
        said = (
            pipe.read1(4000).decode(errors="replace")
            if select.select([pipe], [], [], _SECONDS)[0]
            else ""
        )
    _, status = os.waitpid(id, 0)
    return said or f"not: ended by {status}"


def _told(name: str, assets: Assets, first: Callable[[], object]) -> str:
    try:
        first()
        return f"got {ATTEMPTS[name](assets)!r}"
    except BaseException as error:  # noqa: BLE001 - whatever it is, it is told
        return f"not: {type(error).__name__} {error}"


def call(name: str, *arguments: object) -> int:
    """Make a system call by its number.

    Raises:
        OSError: The kernel refuses.
    """
    machine = architecture()
    assert machine is not None
    number = machine.calls[name]
    if number is None:
        raise OSError(errno.ENOSYS, "there is no such call")
    return called(number, *arguments)


def called(number: int, *arguments: object) -> int:
    given = [ctypes.c_long(each) if isinstance(each, int) else each for each in arguments]
    result = int(LIBC.syscall(ctypes.c_long(number), *given))
    if result < 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    return result


def looked_at(name: str, *arguments: object) -> str:
    """Make a call that comes to nothing; raises where it is refused whatever it asks for."""
    try:
        return f"{name} returned {call(name, *arguments)}"
    except OSError as error:
        if error.errno in _REFUSALS:
            raise
        return f"{name} was looked at: {error}"


# Files of others.


def _secret_in(path: str) -> bytes:
    found = Path(path).read_bytes()
    if b"SECRET" not in found:
        raise OSError(f"{len(found)} bytes, no secret")
    return found[:60]


@attempt
def read_database(assets: Assets) -> object:
    return _secret_in(assets["database"])


@attempt
def read_upload(assets: Assets) -> object:
    return _secret_in(assets["upload"])


@attempt
def read_result(assets: Assets) -> object:
    return _secret_in(assets["result"])


@attempt
def read_home(assets: Assets) -> object:
    return _secret_in(assets["home"])


@attempt
def read_open_file(assets: Assets) -> object:
    return _secret_in(assets["open"])


@attempt
def list_folder(assets: Assets) -> object:
    found = os.listdir(assets["folder"])
    return found or 1 / 0


@attempt
def state_of_file(assets: Assets) -> object:
    return os.stat(assets["database"]).st_size  # noqa: PTH116


@attempt
def watch_folder(assets: Assets) -> object:
    watcher = LIBC.inotify_init1(0)
    return call("inotify_add_watch", watcher, assets["folder"].encode(), 0x100)


@attempt
def write_database(assets: Assets) -> object:
    with open(assets["database"], "ab") as file:
        return file.write(b"HOSTILE")


@attempt
def truncate_by_name(assets: Assets) -> object:
    return os.truncate(assets["doomed"], 0)


@attempt
def remove(assets: Assets) -> object:
    return os.unlink(assets["removed"])


@attempt
def rename(assets: Assets) -> object:
    return os.rename(assets["renamed"], assets["renamed"] + "-hostile")


@attempt
def change_mode(assets: Assets) -> object:
    return os.chmod(assets["moded"], 0o666)


@attempt
def change_times(assets: Assets) -> object:
    return os.utime(assets["moded"], (1, 1))


@attempt
def set_attribute(assets: Assets) -> object:
    return os.setxattr(assets["moded"], "user.hostile", b"1")


@attempt
def link_database(assets: Assets) -> object:
    os.link(assets["database"], f"{assets['place']}/index.html")
    return _secret_in(f"{assets['place']}/index.html")


@attempt
def link_softly(assets: Assets) -> object:
    return os.symlink(assets["database"], f"{assets['place']}/report.html")


@attempt
def make_pipe_with_name(assets: Assets) -> object:
    return os.mkfifo(f"{assets['place']}/pipe")


@attempt
def open_by_handle(_: Assets) -> object:
    handle = struct.pack("Ii", 128, 0) + bytes(128)
    buffer = ctypes.create_string_buffer(handle, len(handle))
    return looked_at("open_by_handle_at", -100, buffer, 0)


@attempt
def write_program_file(assets: Assets) -> object:
    return Path(assets["program"], "planted.py").write_text("raise SystemExit")


@attempt
def write_template(assets: Assets) -> object:
    with open(assets["template"], "a") as file:
        return file.write("HOSTILE")


@attempt
def write_temporary(assets: Assets) -> object:
    return Path(assets["temporary"]).write_text("left behind")


@attempt
def write_shared_memory(assets: Assets) -> object:
    return Path(assets["shared"]).write_text("left behind")


@attempt
def write_working_folder_of_another(assets: Assets) -> object:
    return Path(assets["folder"], "planted").write_text("HOSTILE")


# Secrets of processes.


@attempt
def see_process(assets: Assets) -> object:
    return os.stat(f"/proc/{assets['victim']}").st_uid  # noqa: PTH116


@attempt
def command_of_process(assets: Assets) -> object:
    return _secret_in(f"/proc/{assets['victim']}/cmdline")


@attempt
def environment_of_parent(assets: Assets) -> object:
    return _secret_in(f"/proc/{assets['victim']}/environ")


@attempt
def memory_file(assets: Assets) -> object:
    with open(f"/proc/{assets['victim']}/mem", "rb", buffering=0) as file:
        file.seek(assets["address"])
        return file.read(16)


@attempt
def read_memory(assets: Assets) -> object:
    buffer = ctypes.create_string_buffer(16)
    local = struct.pack("PN", ctypes.addressof(buffer), 16)
    remote = struct.pack("PN", assets["address"], 16)
    return call("process_vm_readv", assets["victim"], local, 1, remote, 1, 0)


@attempt
def trace(assets: Assets) -> object:
    return call("ptrace", 0x4206, assets["victim"], 0, 0)  # PTRACE_SEIZE


@attempt
def trace_launcher(assets: Assets) -> object:
    return call("ptrace", 0x4206, assets["launcher"], 0, 0)


@attempt
def stop_launcher(assets: Assets) -> object:
    os.kill(assets["launcher"], 0)
    return "a signal"


@attempt
def send_signal(assets: Assets) -> object:
    return os.kill(assets["victim"], signal.SIGUSR1)


@attempt
def have_signal_sent(assets: Assets) -> object:
    """By a pipe whose owner another process is made: F_SETOWN, F_SETSIG, O_ASYNC."""
    read, write = os.pipe()
    for command, value in ((8, assets["victim"]), (10, signal.SIGUSR2), (4, 0o20000)):
        call("fcntl", read, command, value)
    return os.write(write, b"x")


@attempt
def limit_another(assets: Assets) -> object:
    new = struct.pack("QQ", 1000, 1000)
    return call("prlimit64", assets["victim"], resource.RLIMIT_NOFILE, new, 0)


@attempt
def slow_another(assets: Assets) -> object:
    return call("setpriority", 0, assets["victim"], 19)


@attempt
def slow_all_of_a_user(_: Assets) -> object:
    return looked_at("setpriority", 2, 4_000_000_000, 19)


# Other machines.


@attempt
def tcp(assets: Assets) -> object:
    return socket.create_connection(("127.0.0.1", assets["tcp"]), timeout=2).send(b"x")


@attempt
def udp(assets: Assets) -> object:
    return socket.socket(type=socket.SOCK_DGRAM).sendto(b"x", ("127.0.0.1", assets["udp"]))


@attempt
def abstract_socket(assets: Assets) -> object:
    with socket.socket(socket.AF_UNIX) as connection:
        connection.connect("\0" + assets["abstract"])
        return "connected"


@attempt
def socket_with_path(assets: Assets) -> object:
    with socket.socket(socket.AF_UNIX) as connection:
        connection.connect(assets["socket"])
        return "connected"


@attempt
def netlink(_: Assets) -> object:
    return socket.socket(socket.AF_NETLINK, socket.SOCK_RAW, 0).fileno()


# Programs.


@attempt
def run_program(_: Assets) -> object:
    return os.posix_spawn("/usr/bin/env", ["env"], {})


@attempt
def run_program_in_memory(_: Assets) -> object:
    file = os.memfd_create("hostile")
    os.write(file, Path("/usr/bin/env").read_bytes())
    _, write = os.pipe()
    if os.fork() == 0:
        os.dup2(write, 1)
        call("execveat", file, b"", struct.pack("PP", 0, 0), struct.pack("P", 0), 0x1000)
    os.close(write)
    _, status = os.wait()
    if os.waitstatus_to_exitcode(status) != 0:
        raise OSError("it does not run")
    return "run"


# Another view of the system.


@attempt
def mount(_: Assets) -> object:
    return looked_at("mount", b"none", b"/usr", b"nosuchfs", 0, 0)


@attempt
def change_root(assets: Assets) -> object:
    return os.chroot(assets["program"])


@attempt
def unshare_user(_: Assets) -> object:
    return call("unshare", 0x10000000)


@attempt
def clone_user(_: Assets) -> object:
    id = call("clone", 0x10000000 | signal.SIGCHLD, 0, 0, 0, 0)
    if id == 0:
        os._exit(0)
    return id


@attempt
def clone_user_by_clone3(_: Assets) -> object:
    arguments = struct.pack("11Q", 0x10000000, 0, 0, 0, signal.SIGCHLD, *[0] * 6)
    id = call("clone3", arguments, len(arguments))
    if id == 0:
        os._exit(0)
    return id


@attempt
def enter_namespace(assets: Assets) -> object:
    file = os.open(f"/proc/{assets['victim']}/ns/net", os.O_RDONLY)
    return call("setns", file, 0)


# What only administrators and debuggers need.


@attempt
def keys(_: Assets) -> object:
    return looked_at("keyctl", 0, -3, 0, 0, 0)


@attempt
def add_key(_: Assets) -> object:
    return looked_at("add_key", b"user", b"hostile", b"x", 1, -2)


@attempt
def rings(_: Assets) -> object:
    return call("io_uring_setup", 2, bytes(120))


@attempt
def bpf(_: Assets) -> object:
    return looked_at("bpf", 0, struct.pack("4I", 2, 4, 4, 1) + bytes(112), 128)


@attempt
def watch_performance(_: Assets) -> object:
    return looked_at("perf_event_open", 0, 0, -1, -1, 0)


@attempt
def user_faults(_: Assets) -> object:
    return call("userfaultfd", 1)


@attempt
def load_module(_: Assets) -> object:
    return looked_at("init_module", 0, 0, 0)


@attempt
def read_kernel_log(_: Assets) -> object:
    return looked_at("syslog", 10, 0, 0)


@attempt
def type_into_terminal(_: Assets) -> object:
    return looked_at("ioctl", 1, 0x5412, b"x")


@attempt
def shared_memory(_: Assets) -> object:
    return looked_at("shmat", 2_000_000_000, 0, 0)


@attempt
def message_queue(_: Assets) -> object:
    return looked_at("msgctl", 2_000_000_000, 0, 0)


@attempt
def unlink_message_queue(_: Assets) -> object:
    return looked_at("mq_unlink", b"nosuchqueue")


@attempt
def call_as_x32(_: Assets) -> object:
    return called(_X32 + 39)


@attempt
def call_as_32_bits(_: Assets) -> object:
    """By an instruction of 32-bit programs, for which calls have other numbers."""
    if os.uname().machine != "x86_64":
        raise OSError(errno.ENOSYS, "another processor")
    memory = mmap.mmap(-1, 4096, prot=mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC)
    memory.write(_INT_80)
    address = ctypes.addressof(ctypes.c_char.from_buffer(memory))
    found = ctypes.CFUNCTYPE(ctypes.c_int)(address)()
    if found <= 0:
        raise OSError(-found, "refused")
    return found


# Itself.


@attempt
def own_environment(_: Assets) -> object:
    return _secret_in("/proc/self/environ") or os.environ["TOKEN"]


@attempt
def token_in_environment(_: Assets) -> object:
    return next(name for name, value in os.environ.items() if "SECRET" in value)


@attempt
def inherited_descriptors(assets: Assets) -> object:
    """Anything but streams, request, answer, and of one that works the socket for others."""
    found = {number: kind_of(number) for number in range(1024)}
    # The pipe of this very attempt is one more, and the answer is open twice while it is made.
    strange = [kind for kind in found.values() if kind not in ("", "none", "pipe", "file")]
    most = {"pipe": 2, "file": 3}
    counts = {kind: [*found.values()].count(kind) for kind in most}
    if counts == most and strange == (["socket"] if assets["works"] else []):
        raise OSError("only its own")
    return found


def kind_of(number: int) -> str:
    try:
        found = os.fstat(number)
    except OSError:
        return ""
    if stat.S_ISREG(found.st_mode):
        return "file" if found.st_nlink == 0 else f"named file {found.st_ino}"
    if stat.S_ISFIFO(found.st_mode):
        return "pipe"
    if stat.S_ISSOCK(found.st_mode):
        return "socket"
    return "none" if found.st_rdev == os.makedev(1, 3) else f"{found.st_mode:o}"


@attempt
def become_root(_: Assets) -> object:
    os.setuid(0)
    return "root" if os.getuid() == 0 else 1 / 0


@attempt
def raise_limits(_: Assets) -> object:
    return resource.setrlimit(resource.RLIMIT_NOFILE, (100_000, 100_000))


@attempt
def dump_core(_: Assets) -> object:
    resource.setrlimit(resource.RLIMIT_CORE, (1000, 1000))
    return "may dump"


@attempt
def many_processes(_: Assets) -> object:
    """More than 512 of them, each waiting for the end of this one."""
    read, write = os.pipe()
    for _number in range(700):
        try:
            id = os.fork()
        except BlockingIOError:
            os.close(write)
            raise
        if id == 0:
            signal.alarm(_SECONDS)
            os.close(write)
            os.read(read, 1)
            os._exit(0)
    os.close(write)
    return "as many as it likes"


@attempt
def leave_group(_: Assets) -> object:
    """Each in a process of its own, which is no first one of a session or group."""
    return LIBC.setpgid(0, 0) == 0 or LIBC.setsid() > 0 or 1 / 0


@attempt
def outlive(assets: Assets) -> object:
    """Leave session, group and parent, and go on."""
    if os.fork() == 0:
        os.setsid()
        LIBC.prctl(1, 0, 0, 0, 0)  # PR_SET_PDEATHSIG
        LIBC.prctl(15, assets["mark"].encode(), 0, 0, 0)  # PR_SET_NAME
        if os.fork() == 0:
            os.closerange(0, 1024)
            time.sleep(30)
        os._exit(0)
    return "left"


if __name__ == "__main__":
    sys.exit("loaded in the sandbox")
