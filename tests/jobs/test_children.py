"""The process of the next check is there before the check, and serves that one alone."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing
from pathlib import Path

import pytest

from checker.base.sandbox.launcher import OwnLauncher
from checker.base.sandbox.layers import NAMESPACES
from checker.service.jobs.check import check_upload
from checker.service.jobs.children import Children
from checker.service.jobs.exchange import NICENESS, TRIAL_NICENESS
from checker.service.jobs.outcome import Checked, Outcome
from checker.service.jobs.port import Order, Stage
from checker.service.store.store import Store
from support.service import zip_of
from tests.conftest import SAMPLES
from tests.jobs.launched import is_alive, launchers, parent_of, tasks, wait_for
from tests.web.server import eventually

pytestmark = pytest.mark.skipif(not Path("/proc/self").is_dir(), reason="the system has no /proc")

WAITS = """
import sys, time
from pathlib import Path
from checker.service.jobs.children import Children
from checker.service.store.store import Store
children = Children(Store(Path(sys.argv[1])))
children.get_ready()
time.sleep(600)
"""
AT_ONCE = 4
WAITING = 2
"""Processes that wait: one that checks, and one that reads meshes beside it."""


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "data")


@pytest.fixture
def children(store: Store) -> Iterator[Children]:
    with closing(Children(store)) as made:
        yield made


def killed(process: int) -> None:
    """Kill a process, and wait until it has died: the system takes its time."""
    os.kill(process, signal.SIGKILL)
    assert eventually(lambda: not is_alive(process))


def check(
    store: Store, children: Children, look: Callable[[], object], stage: Stage = Stage.STATIC
) -> Outcome:
    """Check a model that was not there before; look around meanwhile."""
    model = b"<sdf version='1.6'>" + os.urandom(8).hex().encode() + b"</sdf>"
    return check_file(store, children, look, model, "model.sdf", stage)


def check_file(
    store: Store,
    children: Children,
    look: Callable[[], object],
    data: bytes,
    name: str,
    stage: Stage = Stage.STATIC,
) -> Outcome:
    """Check an upload; look around meanwhile."""
    with store.incoming() as incoming:
        incoming.write(data)
        order = Order(incoming.finish(), name, "sdf")

    def never() -> bool:
        look()
        return False

    return check_upload(store, children, order, stage, never)


def seen_in(store: Store, children: Children) -> set[int]:
    """Check, and return the processes that were seen meanwhile."""
    seen: set[int] = set()
    outcome = check(store, children, lambda: seen.update(tasks()))
    assert isinstance(outcome, Checked)
    return seen


def nicenesses(process: int) -> set[int]:
    """Return how nice the threads of a process are."""
    threads = Path(f"/proc/{process}/task").iterdir()
    fields = [(thread / "stat").read_text().rpartition(")")[2].split() for thread in threads]
    return {int(field[16]) for field in fields}


def test_one_that_waits_takes_the_next_check(store: Store, children: Children) -> None:
    children.get_ready()
    first = wait_for(WAITING)
    assert first[0] in seen_in(store, children)
    second = wait_for(WAITING)
    assert not {*first} & {*second}
    assert second[0] in seen_in(store, children)


@pytest.mark.parametrize("whom", ["itself", "its launcher"])
def test_one_that_died_is_not_missed(whom: str, store: Store, children: Children) -> None:
    children.get_ready()
    first, _ = wait_for(WAITING)
    killed(first if whom == "itself" else parent_of(first))
    assert eventually(lambda: not is_alive(first))
    seen = seen_in(store, children)
    assert seen
    assert first not in seen


@pytest.mark.parametrize("ready", [False, True])
@pytest.mark.parametrize(
    ("stage", "niceness"),
    [(Stage.STATIC, NICENESS), (Stage.TRIAL, NICENESS + TRIAL_NICENESS)],
)
def test_all_of_its_threads_stand_back(
    store: Store, children: Children, stage: Stage, niceness: int, ready: bool
) -> None:
    """Behind the service, and those of a trial behind those that look for first findings."""
    if ready:
        children.get_ready()
        wait_for(WAITING)
    seen: list[set[int]] = []
    outcome = check(store, children, lambda: seen.extend(map(nicenesses, tasks())), stage)
    assert isinstance(outcome, Checked)
    assert seen[-1] == {min(os.getpriority(os.PRIO_PROCESS, 0) + niceness, 19)}


@pytest.mark.skipif(
    not Path("/proc/self/autogroup").is_file(), reason="the system puts no sessions into groups"
)
def test_those_that_start_at_once_all_stand_back_as_a_group() -> None:
    with ExitStack() as stack:
        started = [
            stack.enter_context(closing(OwnLauncher(niceness=NICENESS))) for _ in range(AT_ONCE)
        ]
        assert all(launcher.layers for launcher in started)
        found = [Path(f"/proc/{process}/autogroup").read_text() for process in launchers()]
        assert [text.split()[-1] for text in found] == AT_ONCE * [str(NICENESS)]


def test_one_that_waits_knows_no_secret_and_has_no_network(
    children: Children, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SUBT_CHECK_TOKENS", "hunter2")
    monkeypatch.setenv("SUBT_CHECK_DATABASE_URL", "postgresql://x:hunter2@x/x")
    children.get_ready()
    own = Path("/proc/self/ns/net").readlink()
    for process in wait_for(WAITING):
        assert b"hunter2" not in Path(f"/proc/{process}/environ").read_bytes()
        network = Path(f"/proc/{process}/ns/net").readlink()
        assert network != own or not may_leave_the_network()


def may_leave_the_network() -> bool:
    with closing(OwnLauncher(names=(NAMESPACES,))) as tried:
        return tried.layers[0].held


def test_one_that_reads_meshes_waits_beside_it(
    store: Store, children: Children, tmp_path: Path
) -> None:
    archive = zip_of([SAMPLES / "husky_description"], tmp_path / "husky.zip").read_bytes()
    children.get_ready()
    _, reader = wait_for(WAITING)
    seen: set[int] = set()
    outcome = check_file(store, children, lambda: seen.update(tasks()), archive, "husky.zip")
    assert isinstance(outcome, Checked)
    assert reader in seen
    assert list((store.folder / "parts").glob("*/*/cache/facts/*/*.json"))
    assert not is_alive(reader)


def test_one_that_reads_meshes_and_died_is_not_missed(
    store: Store, children: Children, tmp_path: Path
) -> None:
    archive = zip_of([SAMPLES / "husky_description"], tmp_path / "husky.zip").read_bytes()
    children.get_ready()
    killed(wait_for(WAITING)[1])
    outcome = check_file(store, children, lambda: None, archive, "husky.zip")
    assert isinstance(outcome, Checked)
    assert list((store.folder / "parts").glob("*/*/cache/facts/*/*.json"))


def test_none_waits_after_the_end_and_a_check_goes_on(store: Store, children: Children) -> None:
    children.get_ready()
    wait_for(WAITING)
    assert isinstance(check(store, children, children.close), Checked)
    children.close()
    assert not tasks()
    assert not list((store.folder / "incoming").iterdir())


def test_one_that_waits_ends_with_the_service(store: Store, children: Children) -> None:
    children.get_ready()
    wait_for(WAITING)
    children.close()
    assert eventually(lambda: not tasks())
    assert eventually(lambda: not launchers())
    assert not list((store.folder / "incoming").iterdir())


def test_one_that_waits_ends_with_its_worker(tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", WAITS, str(tmp_path)]) as worker:
        processes = wait_for(WAITING, worker.pid)
        worker.kill()
    assert eventually(lambda: not any(map(is_alive, processes)))


def test_what_a_check_has_worked_out_serves_the_same_upload_alone(
    store: Store, children: Children, tmp_path: Path
) -> None:
    """One that was taken over could keep wrong results: of its own upload, and of no other."""
    archive = zip_of([SAMPLES / "husky_description"], tmp_path / "husky.zip").read_bytes()
    for data in (archive, archive + b"\0"):
        assert isinstance(check_file(store, children, lambda: None, data, "a.zip"), Checked)
    kept = [
        {path.name for path in each.rglob("facts/*/*")} for each in store.folder.glob("parts/*/*")
    ]
    assert len(kept) == 2
    assert kept[0] == kept[1] != set()
