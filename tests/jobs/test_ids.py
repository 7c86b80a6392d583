"""Ids of checks cannot be guessed: they are all that keeps a report from strangers."""

from __future__ import annotations

import base64
from pathlib import Path

from checker.jobs.durable.client import durable_jobs
from checker.jobs.port import Order
from checker.store.store import Store


def test_an_id_is_128_random_bits(tmp_path: Path) -> None:
    jobs = durable_jobs(f"sqlite:///{tmp_path}/jobs.sqlite", Store(tmp_path))
    order = Order("0" * 64, "robot.zip")
    drawn = [base64.urlsafe_b64decode(jobs.submit(order) + "==") for _ in range(8)]
    assert {len(bits) for bits in drawn} == {16}
    # Nothing but chance is in them: no byte is the same in all, as in a time or a number.
    assert all(len({bits[at] for bits in drawn}) > 1 for at in range(16))
