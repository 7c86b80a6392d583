"""A sample from upload to report, by a real worker; and what is left of a check that is killed."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from time import monotonic, sleep

import pytest

from checker.jobs.port import Order, Stage
from checker.sandbox.task import end_with_parent
from tests.jobs.site import ROOT, Site, site_in

WORKER = """
import sys
from pathlib import Path
from checker.jobs.durable.worker import WorkerOptions, work
from checker.store.store import Store
work(WorkerOptions(sys.argv[1], Store(Path(sys.argv[2])), "slot-1"))
"""
MODEL = "broken_ouster_description"


@pytest.fixture
def site(tmp_path: Path) -> Iterator[Site]:
    site = site_in(tmp_path, f"sqlite:///{tmp_path}/jobs.sqlite")
    yield site
    site.close()


def worker(site: Site) -> subprocess.Popen[bytes]:
    process = subprocess.Popen(
        [sys.executable, "-c", WORKER, site.url, str(site.store.folder)],
        cwd=ROOT,
        preexec_fn=end_with_parent,  # noqa: PLW1509 - one call of the system, no lock
    )
    site.running.append(process)
    return process


def ordered(site: Site, samples: Path, tmp_path: Path) -> Order:
    import shutil

    archive = shutil.make_archive(str(tmp_path / MODEL), "zip", samples, MODEL)
    with site.store.incoming() as incoming:
        incoming.write(Path(archive).read_bytes())
        return Order(incoming.finish(), f"{MODEL}.zip")


def children_of(process: subprocess.Popen[bytes]) -> list[int]:
    """Return the ids of the processes that a process has started, as Linux lists them."""
    tasks = Path(f"/proc/{process.pid}/task").iterdir()
    return [int(id) for task in tasks for id in (task / "children").read_text().split()]


def runs(id: int) -> bool:
    with suppress(OSError):
        return Path(f"/proc/{id}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    return False


def works_in(site: Site, id: int) -> bool:
    with suppress(OSError):
        return Path(f"/proc/{id}/cwd").readlink().is_relative_to(site.store.folder)
    return False


def within_a_minute(what: object) -> Iterator[None]:
    deadline = monotonic() + 60
    while monotonic() < deadline:
        yield
        sleep(0.05)
    pytest.fail(f"waited in vain for {what}")


@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="the system has no /proc")
def test_a_sample_is_checked_though_its_worker_is_killed(
    site: Site, samples: Path, tmp_path: Path
) -> None:
    order = ordered(site, samples, tmp_path)
    first = worker(site)
    id = site.jobs.submit(order)
    for _ in within_a_minute("a child that checks"):
        if children := [each for each in children_of(first) if works_in(site, each)]:
            break
    first.kill()
    first.wait()
    for _ in within_a_minute("the end of that child"):
        if not any(map(runs, children)):
            break
    worker(site)
    read = site.until(id, lambda state: state.result != "")
    errors = read.packages[0]["errors"]
    assert (read.packages[0]["verdict"], errors > 0) == ("not_ready", True)
    assert site.store.names(read.result) == ("report.json",)
    done = site.end(id)
    assert done.stage is Stage.DONE
    assert done.words.startswith("Not ready")
    names = {"report.html", "report.json", "report.sarif", "robot.glb"}
    assert set(site.store.names(done.result)) == names
    file = site.store.file(done.result, "report.json")
    assert file is not None
    assert json.loads(file.read_bytes())["packages"][0]["verdict"] == "not_ready"
    assert list((site.store.folder / "incoming").iterdir()) == []
