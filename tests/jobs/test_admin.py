"""`subt-check admin` lists, requeues, cancels, drains and deletes, on both databases."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace

from checker import cli
from checker.service.jobs.durable.receipts import key_of_check
from checker.service.jobs.durable.tasks import TRIES
from checker.service.jobs.port import Stage
from support.postgres import DATABASES, fresh_database
from tests.jobs.quick_worker import DEATH, FULL
from tests.jobs.site import Site, site_in


@pytest.fixture(params=DATABASES)
def site(
    request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Site]:
    """A service as the command finds it."""
    data = tmp_path / "store"
    data.mkdir()
    if request.param == "sqlite":
        url = f"sqlite:///{data}/jobs.sqlite"
        monkeypatch.delenv("SUBT_CHECK_DATABASE_URL", raising=False)
    else:
        url = fresh_database(request.getfixturevalue("postgres_url"))
        monkeypatch.setenv("SUBT_CHECK_DATABASE_URL", url)
    monkeypatch.setenv("SUBT_CHECK_DATA", str(data))
    monkeypatch.delenv("SUBT_CHECK_STORE", raising=False)
    site = site_in(tmp_path, url)
    yield site
    site.close()


class Said:
    """What the command says."""

    def __init__(self, capsys: pytest.CaptureFixture[str]) -> None:
        self._capsys = capsys

    def __call__(self, *words: str, code: int = 0) -> str:
        assert cli.main(["admin", *words]) == code
        said = self._capsys.readouterr()
        return said.err if code else said.out

    def listed(self) -> list[dict[str, Any]]:
        return list(json.loads(self("list", "--json")))


@pytest.fixture
def said(capsys: pytest.CaptureFixture[str]) -> Iterator[Said]:
    mask = os.umask(0o077)
    yield Said(capsys)
    os.umask(mask)


def test_it_lists_what_is_not_over_and_what_failed(site: Site, said: Said) -> None:
    assert said.listed() == []
    assert said("list").split() == ["KEY", "STAGE", "TRY", "AGE", "WORKER", "WORDS"]
    site.worker("one")
    done, refused, failed = (site.submit(each) for each in ("", "refused", "died"))
    for id in (done, refused, failed):
        site.end(id)
    runs = site.submit("static:600")
    site.in_hand(runs, Stage.STATIC)
    waits = site.submit()
    died, running, waiting = said.listed()
    assert [each["key"] for each in (died, running, waiting)] == [
        key_of_check(each) for each in (failed, runs, waits)
    ]
    assert (died["stage"], died["try"], died["words"]) == ("failed", 1, DEATH)
    assert running["worker"].startswith("one-")
    assert (running["stage"], running["words"]) == ("static", "the static rules are running")
    assert (waiting["stage"], waiting["worker"]) == ("queued", "")
    assert 0.0 <= waiting["age"] <= died["age"] < 300.0
    shown = said("list").splitlines()
    assert shown[1].split()[:3] == [key_of_check(failed)[:12], "failed", "1"]
    assert not [id for id in (failed, runs, waits) if id in "\n".join(shown)]


@pytest.mark.parametrize("profile", [f"full:trial:{TRIES}", f"full:static:{TRIES}"])
def test_a_check_that_was_given_up_is_begun_anew(site: Site, said: Said, profile: str) -> None:
    site.worker()
    receipt = site.receipt(profile)
    id = receipt.id
    failed = site.end(id)
    assert failed.stage is Stage.FAILED
    assert FULL in failed.words
    assert said("requeue", "--failed") == f"requeued {key_of_check(id)}\n"
    again = site.end(id)
    assert again.stage is Stage.DONE
    assert (again.created, again.expires) == (failed.created, failed.expires)
    assert said("requeue", "--failed") == "no check has failed\n"
    assert site.jobs.delete(id, receipt.secret), "its sender may do so still"


def test_one_that_fails_again_can_be_begun_again(site: Site, said: Said) -> None:
    site.worker()
    id = site.submit("died")
    for number in (1, 2, 3):
        assert site.end(id).words == DEATH
        assert site.begun()[f"static {site.state(id).order.name}"] == number
        said("requeue", key_of_check(id)[:12])


def test_it_cancels_what_is_not_over(site: Site, said: Said) -> None:
    site.worker()
    runs = site.submit("static:600")
    name = site.in_hand(runs, Stage.STATIC).order.name
    waits = site.submit()
    assert said("cancel", waits, key_of_check(runs)) == "".join(
        f"cancelled {key_of_check(each)}\n" for each in (waits, runs)
    )
    assert {site.state(each).stage for each in (runs, waits)} == {Stage.CANCELLED}
    site.until(runs, lambda _: site.begun()[f"stopped-static {name}"] > 0)
    assert said.listed() == []


def test_it_does_nothing_where_one_of_the_checks_is_not_meant(site: Site, said: Said) -> None:
    waits = site.submit()
    key = key_of_check(waits)
    assert f"{key} is queued, expected one that has failed" in said("requeue", key, code=2)
    said("cancel", waits)
    assert f"{key} is cancelled, expected one that waits or runs" in said("cancel", key, code=2)
    other = site.submit()
    assert "no check has the key 'nobody'" in said("cancel", other, "nobody", code=2)
    assert site.state(other).stage is Stage.QUEUED


def test_a_drained_worker_finishes_what_it_has_and_takes_nothing_more(
    site: Site, said: Said
) -> None:
    drained = site.worker("drained", grace_seconds=0.1)
    runs = site.submit("static:3")
    name = site.in_hand(runs, Stage.STATIC).order.name
    waits = site.submit()
    assert "no worker nobody is alive, expected one of: drained-" in said(
        "drain", "drained", "nobody", code=2
    )
    assert said("drain", "drained").startswith("drains drained-")
    assert drained.wait(60) == 0
    assert site.begun()[f"static {name}"] == 1
    assert site.state(runs).result, "its static rules were finished"
    assert site.state(waits).stage is Stage.QUEUED
    site.worker("next")
    assert {site.end(each).stage for each in (runs, waits)} == {Stage.DONE}
    assert site.begun()[f"static {name}"] == 1


def test_a_signal_ends_a_drained_worker_in_its_usual_time(site: Site, said: Said) -> None:
    worker = site.worker(grace_seconds=0.5)
    id = site.submit("static:600")
    site.in_hand(id, Stage.STATIC)
    said("drain")
    time.sleep(1.0)
    assert worker.poll() is None
    worker.terminate()
    assert worker.wait(60) == 0
    assert site.state(id).words == "waiting in the queue"


def test_it_deletes_what_is_due(site: Site, said: Said) -> None:
    jobs = replace(site.jobs, retention_days=0.0)
    id = jobs.submit(order := site.order()).id
    stays = site.submit()
    upload = site.store.upload(order.upload)
    assert upload is not None
    os.utime(upload, (0, 0))
    assert said("retention") == "deleted: checks 1, uploads 1, results 0, parts 0\n"
    assert site.jobs.status(id) is None
    assert site.state(stays).stage is Stage.QUEUED
    assert said("retention") == "deleted: checks 0, uploads 0, results 0, parts 0\n"


def test_a_folder_without_a_service_stays_empty(tmp_path: Path, said: Said) -> None:
    assert "has no jobs.sqlite, expected the data folder of a service" in said(
        "list", "--data", str(tmp_path), code=2
    )
    assert not list(tmp_path.iterdir())
