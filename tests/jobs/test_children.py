"""The process of the next check is there before the check, and serves that one alone."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from pathlib import Path
from time import monotonic, sleep

import pytest

from checker.jobs.checking import check_upload
from checker.jobs.children import Children
from checker.jobs.isolation import StageLimits
from checker.jobs.outcome import Checked, Outcome
from checker.jobs.port import Order, Stage
from checker.store.store import Store
from tests.conftest import SAMPLES
from tests.web.server import eventually
from tests.web.service import zip_of

pytestmark = pytest.mark.skipif(not Path("/proc/self").is_dir(), reason="the system has no /proc")

WAITS = """
import sys, time
from pathlib import Path
from checker.jobs.children import Children
children = Children(Path(sys.argv[1]))
children.get_ready()
time.sleep(600)
"""
READER = "checker.mesh.worker"
MAY_LEAVE = "import ctypes; raise SystemExit(ctypes.CDLL(None).unshare(0x50000000))"


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "data")


@pytest.fixture
def children(store: Store) -> Iterator[Children]:
    with closing(Children(store.cache)) as made:
        yield made


def started_by(parent: int, module: str = "checker.jobs.checking_child") -> list[int]:
    """Return the children of a process that run a module and are not dead."""
    found = []
    for each in Path("/proc").glob("[0-9]*"):
        try:
            state, its_parent = (each / "stat").read_text().rpartition(")")[2].split()[:2]
            ours = module.encode() in (each / "cmdline").read_bytes()
        except OSError:
            continue
        if ours and int(its_parent) == parent and state != "Z":
            found.append(int(each.name))
    return found


def is_alive(process: int) -> bool:
    """Whether a process is there and no zombie."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def killed(process: int) -> None:
    """Kill a process, and wait until it has died: the system takes its time."""
    os.kill(process, signal.SIGKILL)
    assert eventually(lambda: not is_alive(process))


def the_one(parent: int, module: str = "checker.jobs.checking_child") -> int:
    """Wait until a process has one child that runs a module, and return it."""
    deadline = monotonic() + 20
    while len(started_by(parent, module)) != 1 and monotonic() < deadline:
        sleep(0.02)
    (child,) = started_by(parent, module)
    return child


def check(store: Store, children: Children, look: Callable[[], object]) -> Outcome:
    """Check a model that was not there before; look around meanwhile."""
    model = b"<sdf version='1.6'>" + os.urandom(8).hex().encode() + b"</sdf>"
    return check_file(store, children, look, model, "model.sdf")


def check_file(
    store: Store, children: Children, look: Callable[[], object], data: bytes, name: str
) -> Outcome:
    """Check an upload; look around meanwhile."""
    with store.incoming() as incoming:
        incoming.write(data)
        order = Order(incoming.finish(), name, "sdf")

    def never() -> bool:
        look()
        return False

    return check_upload(store, children, order, Stage.STATIC, never)


def children_in(store: Store, children: Children) -> set[int]:
    """Check, and return the children that were seen meanwhile."""
    seen: set[int] = set()
    outcome = check(store, children, lambda: seen.update(started_by(os.getpid())))
    assert isinstance(outcome, Checked)
    return seen


def nicenesses(process: int) -> set[int]:
    """Return how nice the threads of a process are."""
    tasks = Path(f"/proc/{process}/task").iterdir()
    fields = [(task / "stat").read_text().rpartition(")")[2].split() for task in tasks]
    return {int(field[16]) for field in fields}


def test_one_that_waits_takes_the_next_check(store: Store, children: Children) -> None:
    children.get_ready()
    first = the_one(os.getpid())
    assert children_in(store, children) == {first}
    second = the_one(os.getpid())
    assert first != second
    assert children_in(store, children) == {second}


def test_one_that_died_is_not_missed(store: Store, children: Children) -> None:
    children.get_ready()
    first = the_one(os.getpid())
    killed(first)
    seen = children_in(store, children)
    assert seen
    assert first not in seen


def test_all_of_its_threads_stand_back_behind_the_service(store: Store, children: Children) -> None:
    seen: list[set[int]] = []
    outcome = check(store, children, lambda: seen.extend(map(nicenesses, started_by(os.getpid()))))
    assert isinstance(outcome, Checked)
    assert seen[-1] == {min(os.getpriority(os.PRIO_PROCESS, 0) + 10, 19)}


def test_one_that_waits_knows_no_secret_and_has_no_network(
    children: Children, monkeypatch: pytest.MonkeyPatch
) -> None:
    if subprocess.run([sys.executable, "-c", MAY_LEAVE], check=False).returncode != 0:
        pytest.skip("this system does not let processes leave the network")
    monkeypatch.setenv("SUBT_CHECK_TOKENS", "hunter2")
    children.get_ready()
    child, deadline = Path(f"/proc/{the_one(os.getpid())}"), monotonic() + 20
    own = Path("/proc/self/ns/net").readlink()
    while (child / "ns/net").readlink() == own and monotonic() < deadline:
        sleep(0.02)
    assert (child / "ns/net").readlink() != own
    assert b"hunter2" not in (child / "environ").read_bytes()


def test_one_that_reads_meshes_waits_beside_it(
    store: Store, children: Children, tmp_path: Path
) -> None:
    archive = zip_of([SAMPLES / "husky_description"], tmp_path / "husky.zip").read_bytes()
    children.get_ready()
    child = the_one(os.getpid())
    reader = the_one(child, READER)
    held = f"Max open files            {StageLimits(1.0).open_files}"
    seen: set[int] = set()
    limits = ""

    def look() -> None:
        nonlocal limits
        while is_alive(reader) and held not in limits:
            with suppress(OSError):
                limits = Path(f"/proc/{reader}/limits").read_text()
        seen.update(started_by(child, READER))

    outcome = check_file(store, children, look, archive, "husky.zip")
    assert isinstance(outcome, Checked)
    assert seen <= {reader}
    assert held in limits
    assert list((store.cache / "mesh").rglob("*.json"))
    assert not is_alive(reader)


def test_one_that_reads_meshes_and_died_is_not_missed(
    store: Store, children: Children, tmp_path: Path
) -> None:
    archive = zip_of([SAMPLES / "husky_description"], tmp_path / "husky.zip").read_bytes()
    children.get_ready()
    killed(the_one(the_one(os.getpid()), READER))
    outcome = check_file(store, children, lambda: None, archive, "husky.zip")
    assert isinstance(outcome, Checked)
    assert list((store.cache / "mesh").rglob("*.json"))


def test_one_that_reads_meshes_ends_with_the_service(children: Children) -> None:
    children.get_ready()
    reader = the_one(the_one(os.getpid()), READER)
    children.close()
    assert eventually(lambda: not is_alive(reader))


def test_none_waits_after_the_end_and_a_check_goes_on(store: Store, children: Children) -> None:
    children.get_ready()
    the_one(os.getpid())
    assert isinstance(check(store, children, children.close), Checked)
    children.close()
    assert not started_by(os.getpid())


def test_one_that_waits_ends_with_the_service(children: Children) -> None:
    children.get_ready()
    the_one(os.getpid())
    children.close()
    assert not started_by(os.getpid())


def test_one_that_waits_ends_with_its_worker(tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", WAITS, str(tmp_path)]) as worker:
        child = Path(f"/proc/{the_one(worker.pid)}")
        worker.kill()
    assert eventually(lambda: not child.exists())
