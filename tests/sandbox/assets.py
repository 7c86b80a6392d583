"""What lies outside the layers: laid out by a test, and looked at again after the attempts."""

from __future__ import annotations

import os
import secrets
import select
import shutil
import socket
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic, sleep
from typing import Any

SECRET = b"SECRET-of-somebody-else"
MAPPED = (
    "import ctypes, signal, time; b = ctypes.create_string_buffer(b'SECRET-of-somebody-else');"
    "say = lambda number, _: print(signal.Signals(number).name, flush=True);"
    "[signal.signal(each, say) for each in (signal.SIGUSR1, signal.SIGUSR2)];"
    "print(ctypes.addressof(b), flush=True);\nwhile True: time.sleep(60)"
)
"""A process that says where its secret lies, and when a signal comes."""


@dataclass
class Outside:
    """All that a process in the sandbox shall not reach.

    Attributes:
        folder: Closed to other users, as the data of the service are.
        given: What the attempts are told of it.
    """

    folder: Path
    given: dict[str, Any]
    victim: subprocess.Popen[str]
    listeners: dict[str, socket.socket] = field(default_factory=dict)
    caught: str = ""

    def got(self) -> dict[str, bool]:
        """Return by attempt whether it has left its mark out here; the others say it themselves."""
        return {name: look(self) for name, look in _LOOKS.items()}

    def survivors(self) -> list[int]:
        """Return the processes that have outlived their launcher, once they had time to end."""
        deadline = monotonic() + 1.0
        while (found := [*named(self.given["mark"])]) and monotonic() < deadline:
            sleep(0.05)
        return found


def named(mark: str) -> Iterator[int]:
    """Yield the processes that have given themselves a name."""
    for each in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            state = (each / "stat").read_text().rpartition(")")[2].split()[0]
            if (each / "comm").read_text().strip() == mark and state != "Z":
                yield int(each.name)


@contextmanager
def laid_out() -> Iterator[Outside]:
    """Lay all of it out, below a folder that other users reach, and tidy up at the end."""
    with ExitStack() as held:
        top = Path(tempfile.mkdtemp(prefix="sandbox-", dir="/tmp"))
        held.callback(shutil.rmtree, top, ignore_errors=True)
        top.chmod(0o755)
        given = _files(top)
        held.callback(Path(given["temporary"]).unlink, missing_ok=True)
        held.callback(Path(given["shared"]).unlink, missing_ok=True)
        listeners = {name: held.enter_context(made) for name, made in _listeners(given).items()}
        victim = held.enter_context(_victim())
        held.callback(victim.kill)
        assert victim.stdout is not None
        given |= {"victim": victim.pid, "address": int(victim.stdout.readline())}
        yield Outside(top / "data", given, victim, listeners)


def _victim() -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-c", MAPPED],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "SUBT_CHECK_TOKENS": SECRET.decode()},
    )


def _files(top: Path) -> dict[str, Any]:
    data, mark = top / "data", secrets.token_hex(4)
    given: dict[str, Any] = {"mark": f"hostile{mark}", "abstract": f"sandbox-{mark}"}
    for name, place in (
        ("database", data / "jobs.sqlite"),
        ("upload", data / "uploads/ab/abcd"),
        ("result", data / "results/ab/abcd/report.json"),
        ("home", top / "home/.netrc"),
        *((name, data / name) for name in ("doomed", "removed", "renamed", "moded")),
        ("open", top / "open/file"),
        ("template", top / "program/templates/page.html"),
    ):
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(SECRET)
        place.chmod(0o644 if name in ("open", "template") else 0o600)
        given[name] = str(place)
    for folder in (data, top / "home"):
        folder.chmod(0o700)
    places = {"folder": data, "program": top / "program"}
    return given | {name: str(place) for name, place in places.items()} | _beside(data, mark)


def _beside(data: Path, mark: str) -> dict[str, str]:
    return {
        "socket": str(data / "socket"),
        "temporary": f"/tmp/sandbox-left-{mark}",  # noqa: S108 - where all may write
        "shared": f"/dev/shm/sandbox-left-{mark}",  # noqa: S108
    }


def _listeners(given: dict[str, Any]) -> dict[str, socket.socket]:
    made = {
        "tcp": socket.socket(),
        "udp": socket.socket(type=socket.SOCK_DGRAM),
        "abstract_socket": socket.socket(socket.AF_UNIX),
        "socket_with_path": socket.socket(socket.AF_UNIX),
    }
    for name in ("tcp", "udp"):
        made[name].bind(("127.0.0.1", 0))
        given[name] = made[name].getsockname()[1]
    made["abstract_socket"].bind("\0" + given["abstract"])
    made["socket_with_path"].bind(given["socket"])
    for name, listener in made.items():
        listener.setblocking(False)
        if name != "udp":
            listener.listen()
    return made


def _heard(name: str) -> Callable[[Outside], bool]:
    def look(outside: Outside) -> bool:
        try:
            if name == "udp":
                return bool(outside.listeners[name].recv(1))
            outside.listeners[name].accept()[0].close()
        except BlockingIOError:
            return False
        return True

    return look


def _changed(name: str) -> Callable[[Outside], bool]:
    return lambda outside: Path(outside.given[name]).read_bytes() != SECRET


def _there(*names: str) -> Callable[[Outside], bool]:
    def look(outside: Outside) -> bool:
        return os.path.lexists(Path(outside.given[names[0]], *names[1:]))

    return look


def _caught(name: str) -> Callable[[Outside], bool]:
    def look(outside: Outside) -> bool:
        assert outside.victim.stdout is not None
        while select.select([outside.victim.stdout], [], [], 0.1)[0]:
            outside.caught += os.read(outside.victim.stdout.fileno(), 100).decode()
        return name in outside.caught

    return look


def _moded(outside: Outside) -> bool:
    return Path(outside.given["moded"]).stat().st_mode & 0o777 != 0o600


_LOOKS: Mapping[str, Callable[[Outside], bool]] = {
    "tcp": _heard("tcp"),
    "udp": _heard("udp"),
    "abstract_socket": _heard("abstract_socket"),
    "socket_with_path": _heard("socket_with_path"),
    "send_signal": _caught("SIGUSR1"),
    "have_signal_sent": _caught("SIGUSR2"),
    "write_database": _changed("database"),
    "write_template": _changed("template"),
    "truncate_by_name": _changed("doomed"),
    "remove": lambda outside: not _there("removed")(outside),
    "rename": lambda outside: not _there("renamed")(outside),
    "change_mode": _moded,
    "change_times": lambda outside: Path(outside.given["moded"]).stat().st_mtime < 2,
    "set_attribute": lambda outside: bool(os.listxattr(outside.given["moded"])),
    "write_program_file": _there("program", "planted.py"),
    "write_temporary": _there("temporary"),
    "write_shared_memory": _there("shared"),
    "write_working_folder_of_another": _there("folder", "planted"),
    "outlive": lambda outside: bool(outside.survivors()),
}
"""What is seen from outside counts, whatever a process sees within its own view."""
