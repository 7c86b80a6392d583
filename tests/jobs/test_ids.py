"""Ids of checks cannot be guessed: they are all that keeps a report from strangers."""

from __future__ import annotations

import base64
import hashlib
from pathlib import Path

from checker.service.jobs.durable.client import durable_jobs
from checker.service.jobs.durable.tables import LENGTH, key_of_check
from checker.service.jobs.port import Order
from checker.service.store.store import Store


def test_an_id_is_128_random_bits(tmp_path: Path) -> None:
    jobs = durable_jobs(f"sqlite:///{tmp_path}/jobs.sqlite", Store(tmp_path))
    order = Order("0" * 64, "robot.zip")
    drawn = [base64.urlsafe_b64decode(jobs.submit(order) + "==") for _ in range(8)]
    assert {len(bits) for bits in drawn} == {16}
    # Nothing but chance is in them: no byte is the same in all, as in a time or a number.
    assert all(len({bits[at] for bits in drawn}) > 1 for at in range(16))


def test_the_key_of_a_check_is_a_digest_of_its_own() -> None:
    id = "0123456789abcdefghijkl"
    digest = hashlib.sha256(b"subt-check: key of a check\0" + id.encode()).hexdigest()
    assert key_of_check(id) == digest  # or stored checks would be lost
    assert len(digest) == LENGTH
    assert digest != hashlib.sha256(id.encode()).hexdigest()
    assert key_of_check("\ud800") != key_of_check("")


def test_only_the_id_opens_a_check(tmp_path: Path) -> None:
    jobs = durable_jobs(f"sqlite:///{tmp_path}/jobs.sqlite", Store(tmp_path))
    id = jobs.submit(Order("0" * 64, "robot.zip"))
    state = jobs.status(id)
    assert state is not None
    assert state.id == id
    assert len(jobs.events(id)) == 1
    key = key_of_check(id)
    assert jobs.status(key) is None
    assert jobs.events(key) == []
    assert jobs.cancel(key) is False
    assert jobs.result(key) == ""
    assert jobs.cancel(id) is True
    jobs.engine.dispose()


def test_last_events_go_by_ids_as_well(tmp_path: Path) -> None:
    jobs = durable_jobs(f"sqlite:///{tmp_path}/jobs.sqlite", Store(tmp_path))
    one, other = (jobs.submit(Order("0" * 64, "robot.zip")) for _ in range(2))
    jobs.cancel(other)
    assert jobs.last_events([one, other, "unknown"]) == {one: 1, other: 2}
    assert jobs.last_events([key_of_check(one)]) == {}
    assert jobs.last_events([]) == {}
    jobs.engine.dispose()
