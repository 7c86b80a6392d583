"""Which layer of the layers holds which attempt of native code: each alone, and all together."""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import pytest

from checker.base.child_process import Child, Limits
from checker.base.sandbox import layers, namespaces
from checker.base.sandbox.launcher import OwnLauncher
from tests.sandbox.assets import Outside
from tests.sandbox.attempts import ATTEMPTS
from tests.web.server import eventually

HERE = Path(__file__).parent
LIMITS = Limits(seconds=30, memory=1_000_000_000)
KINDS = ("plain", "draws", "works")

MATRIX = {
    # Files of others.
    "read_database": "B A L",
    "read_upload": "B A L",
    "read_result": "B A L",
    "read_home": "B A L",
    "read_open_file": "B L",
    "list_folder": "B A L",
    "state_of_file": "B A",
    "watch_folder": "B A S",
    "write_database": "B A L",
    "truncate_by_name": "B A L s",
    "remove": "B A L s",
    "rename": "B A L s",
    "change_mode": "B A S",
    "change_times": "B A S",
    "set_attribute": "B A S",
    "link_database": "B A L S",
    "link_softly": "L S",
    "make_pipe_with_name": "L S",
    "open_by_handle": "B A S",
    "write_program_file": "B A L",
    "write_template": "B A L",
    "write_temporary": "B L",
    "write_shared_memory": "B L",
    "write_working_folder_of_another": "B A L",
    # Secrets of processes.
    "see_process": "B",
    "command_of_process": "B L",
    "environment_of_parent": "B A L",
    "memory_file": "B A L",
    "read_memory": "B A L S",
    "trace": "B A L S",
    "trace_launcher": "L S",
    "stop_launcher": "6 S",
    "send_signal": "B A 6 S",
    "have_signal_sent": "B A 6 S",
    "limit_another": "B A S",
    "slow_another": "B A S",
    "slow_all_of_a_user": "S",
    # Other machines.
    "tcp": "N 4 S",
    "udp": "N S",
    "abstract_socket": "N 6 S",
    "socket_with_path": "B A S",
    "netlink": "S",
    # Programs.
    "run_program": "L S",
    "run_program_in_memory": "S",
    # Another view of the system.
    "mount": "B A L S",
    "change_root": "B A S",
    "unshare_user": "S",
    "clone_user": "S",
    "clone_user_by_clone3": "S",
    "enter_namespace": "B A L S",
    # What only administrators and debuggers need.
    "keys": "S",
    "add_key": "S",
    "rings": "S",
    "bpf": "S",
    "watch_performance": "S",
    "user_faults": "S",
    "load_module": "B A S",
    "read_kernel_log": "B S",
    "type_into_terminal": "S",
    "shared_memory": "S",
    "message_queue": "S",
    "unlink_message_queue": "S",
    "call_as_x32": "S",
    "call_as_32_bits": "S",
    # Itself.
    "own_environment": "*",
    "token_in_environment": "*",
    "inherited_descriptors": "*",
    "become_root": "A",
    "raise_limits": "B A",
    "dump_core": "B A",
    "many_processes": "A",
    "leave_group": "S",
    "outlive": "*",
}
"""By attempt, what holds it alone.

N: namespaces, however they are made. B: those that bubblewrap makes. A: an account of its own,
which a process that root starts is given. L: Landlock; 4 and 6: from these versions on. S: the
filter of system calls; s: for processes that do not work in a folder. *: the launcher, without any
layer.
"""
LETTERS = {
    layers.NAMESPACES: "N",
    layers.ACCOUNT: "A",
    layers.LANDLOCK: "L",
    layers.SECCOMP: "S",
}
ONLY_FOR_ROOT = {"become_root", "raise_limits", "dump_core"}
"""What others than root cannot do anyway."""
ROOTS = {
    *("become_root", "change_root", "enter_namespace", "mount", "open_by_handle"),
    *("read_kernel_log", "trace_launcher"),
}
"""What others than root get only in part."""
MACHINES_DIFFER = {
    *("bpf", "call_as_32_bits", "call_as_x32", "dump_core", "load_module", "raise_limits", "rings"),
    *("set_attribute", "trace_launcher", "unshare_user", "clone_user", "clone_user_by_clone3"),
    *("user_faults", "watch_performance", "keys", "add_key", "unlink_message_queue"),
}
"""What a kernel lacks, or an administrator has switched off."""
FOR_ONE_WHO_READS_ALL = {"state_of_file"}
"""What an account does not hold that has kept the right to read all files."""
COSTLY = {"many_processes", "outlive"}
"""Made only where they are to be held, or where it is to be seen what is left."""


def claimed(names: Sequence[str], kind: str) -> set[str]:
    """Return the attempts that layers are to hold in a kind of process."""
    letters = {LETTERS[name] for name in names} | {"*"}
    if "N" in letters and not namespaces.bubblewrap():
        letters.add("B")
    if "L" in letters:
        letters |= {each for each in "46" if int(each) <= layers.landlock.version()}
    if "S" in letters and kind != "works":
        letters.add("s")
    return {attempt for attempt, holds in MATRIX.items() if letters & {*holds.split()}}


@dataclass
class Attack:
    """A launcher with some layers, and what its processes may be told of the outside."""

    outside: Outside
    starter: OwnLauncher
    kind: str

    def made(self, names: Sequence[str]) -> dict[str, str]:
        """Return what came of attempts, each of which began in a process of the kind."""
        works = self.kind == "works"
        limits = Limits(LIMITS.seconds, LIMITS.memory, draws=self.kind == "draws")
        asked = {"names": [*names], "assets": self.outside.given | {"works": works}}
        request = json.dumps(asked).encode()
        child = Child("hostile", request, limits, starter=self.starter, works=works)
        said = child.answer()
        assert isinstance(said, bytes), said
        found = json.loads(said)
        assert isinstance(found, dict)
        return found


def attack(outside: Outside, names: Sequence[str], kind: str) -> Attack:
    work = outside.folder.parent / "work"
    work.mkdir(mode=0o700)
    starter = OwnLauncher(work if kind == "works" else None, names)
    return Attack(outside, starter, kind)


def need(starter: OwnLauncher) -> None:
    """Skip a test of layers of which this machine does not have one."""
    for layer in starter.layers:
        if not layer.held:
            pytest.skip(f"{layer.name} does not hold here: {layer.words}")


def got_in(attack: Attack, wanted: set[str]) -> dict[str, str]:
    """Make all attempts, and return those of the wanted ones that came to something."""
    names = [name for name in ATTEMPTS if name in wanted or name not in COSTLY]
    with closing(attack.starter):
        found = attack.made(names)
    seen = attack.outside.got()
    got = {name: said for name, said in found.items() if seen.get(name, said.startswith("got"))}
    for survivor in attack.outside.survivors():
        os.kill(survivor, signal.SIGKILL)
    return {name: said for name, said in got.items() if name in wanted}


def test_the_matrix_names_every_attempt() -> None:
    assert {*MATRIX} == {*ATTEMPTS}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", layers.ALL)
def test_a_layer_alone(name: str, kind: str, outside: Outside) -> None:
    attacked = attack(outside, (name,), kind)
    need(attacked.starter)
    assert got_in(attacked, claimed((name,), kind)) == {}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("wrapped", [True, False], ids=["bubblewrap", "none"])
def test_all_layers_that_there_are(
    wrapped: bool, kind: str, outside: Outside, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not wrapped:
        monkeypatch.setattr(namespaces, "bubblewrap", lambda: "it is left out")
    attacked = attack(outside, layers.ALL, kind)
    held = {layer.name: layer for layer in attacked.starter.layers if layer.held}
    wanted = claimed([*held], kind)
    if not namespaces.bubblewrap() and layers.NAMESPACES in held:
        wanted |= {*MATRIX} - {"many_processes"}
    if os.getuid() != 0:
        wanted |= ONLY_FOR_ROOT
    elif layers.LANDLOCK in held:
        assert layers.ACCOUNT in held
        wanted -= set() if held[layers.ACCOUNT].hides else FOR_ONE_WHO_READS_ALL
    assert got_in(attacked, wanted) == {}


@pytest.mark.parametrize("kind", KINDS)
def test_without_sandbox_the_attempts_are_real(kind: str, outside: Outside) -> None:
    """Where nothing is held, nearly all of them get what they want: a test of the test."""
    attacked = attack(outside, (), kind)
    missing = {*MATRIX} - COSTLY - {*got_in(attacked, {*MATRIX} - COSTLY)}
    missing -= {name for name in MATRIX if "*" in MATRIX[name]} | MACHINES_DIFFER
    assert missing - (set() if os.getuid() == 0 else ROOTS) == set()


def test_nothing_outlives_a_launcher_without_namespaces(outside: Outside) -> None:
    """What leaves its session becomes a child of the launcher, which ends it."""
    if not Path(f"/proc/self/task/{os.getpid()}/children").exists():
        pytest.skip("this system does not tell of children (CONFIG_PROC_CHILDREN)")
    attacked = attack(outside, (layers.LANDLOCK, layers.SECCOMP), "works")
    with closing(attacked.starter):
        attacked.made(["outlive"])
    assert eventually(lambda: not outside.survivors())
