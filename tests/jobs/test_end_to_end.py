"""A sample from upload to report, by a real worker; and what is left of a check that is killed."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from checker.base.sandbox.task import end_with_parent
from checker.service.jobs.port import Order, Stage
from tests.jobs.launched import is_alive, tasks
from tests.jobs.site import ROOT, Site, site_in
from tests.web.server import eventually

WORKER = """
import sys
from pathlib import Path
from checker.service.jobs.durable.worker import WorkerOptions, work
from checker.service.store.store import Store
work(WorkerOptions(sys.argv[1], Store(Path(sys.argv[2])), "slot-1"))
"""
MODEL = "broken_gurdy_description"


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


@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="the system has no /proc")
def test_a_sample_is_checked_though_its_worker_is_killed(
    site: Site, samples: Path, tmp_path: Path
) -> None:
    order = ordered(site, samples, tmp_path)
    first = worker(site)
    id = site.jobs.submit(order).id
    site.until(id, lambda state: state.stage is Stage.STATIC)
    assert eventually(lambda: bool(tasks(first.pid)))
    children = tasks(first.pid)
    first.kill()
    first.wait()
    assert eventually(lambda: not any(map(is_alive, children)))
    second = worker(site)
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
    second.terminate()
    second.wait()
    assert list((site.store.folder / "incoming").iterdir()) == []
