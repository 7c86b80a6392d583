"""Ids of checks cannot be guessed: they are all that keeps a report from strangers."""

from __future__ import annotations

import base64
import hashlib
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import astuple

from checker.service.jobs.durable.client import durable_jobs
from checker.service.jobs.durable.receipts import digest_of_secret, key_of_check, receipt_for
from checker.service.jobs.port import Order
from checker.service.store.store import Store


def test_an_id_is_128_random_bits(tmp_path: Path) -> None:
    jobs = durable_jobs(f"sqlite:///{tmp_path}/jobs.sqlite", Store(tmp_path))
    order = Order("0" * 64, "robot.zip")
    drawn = [base64.urlsafe_b64decode(jobs.submit(order).id + "==") for _ in range(8)]
    assert {len(bits) for bits in drawn} == {16}
    # Nothing but chance is in them: no byte is the same in all, as in a time or a number.
    assert all(len({bits[at] for bits in drawn}) > 1 for at in range(16))


def test_an_id_is_no_option_of_a_command() -> None:
    """Of 500 plain ids eight would begin with a hyphen."""
    order = Order("0" * 64, "robot.zip")
    ids = [receipt_for(order, str(seed)).id for seed in range(500)]
    assert {len(id) for id in ids} == {22}
    assert not [id for id in ids if id.startswith("-")]


def test_the_key_of_a_check_is_a_digest_of_its_own() -> None:
    id = "0123456789abcdefghijkl"
    digest = hashlib.sha256(b"subt-check: key of a check\0" + id.encode()).hexdigest()
    assert key_of_check(id) == digest  # or stored checks would be lost
    assert len(digest) == 64
    assert digest != hashlib.sha256(id.encode()).hexdigest()
    assert key_of_check("\ud800") != key_of_check("")


def test_only_the_id_opens_a_check(tmp_path: Path) -> None:
    jobs = durable_jobs(f"sqlite:///{tmp_path}/jobs.sqlite", Store(tmp_path))
    id, secret = astuple(jobs.submit(Order("0" * 64, "robot.zip")))
    state = jobs.status(id)
    assert state is not None
    assert state.id == id
    assert len(jobs.events({id: 0})[id]) == 1
    key = key_of_check(id)
    assert jobs.status(key) is None
    assert jobs.events({key: 0}) == {}
    assert jobs.cancel(key, secret) is False
    assert jobs.cancel(id, secret) is True
    jobs.checks.engine.dispose()


def test_only_the_secret_ends_a_check(tmp_path: Path) -> None:
    jobs = durable_jobs(f"sqlite:///{tmp_path}/jobs.sqlite", Store(tmp_path))
    id, secret = astuple(jobs.submit(Order("0" * 64, "robot.zip")))
    other = jobs.submit(Order("0" * 64, "robot.zip"))
    before = jobs.status(id)
    for wrong in ("", id, other.secret, digest_of_secret(secret), secret[:-1], "\ud800"):
        assert jobs.cancel(id, wrong) is jobs.delete(id, wrong) is False
    assert jobs.status(id) == before
    assert jobs.cancel(id, secret) is jobs.delete(id, secret) is True
    assert jobs.delete(id, secret) is False
    jobs.checks.engine.dispose()


ORDERS = st.builds(Order, st.text(max_size=9), st.text(max_size=9), st.text(max_size=9))


@given(ORDERS, ORDERS, st.text(), st.text())
def test_receipts_are_alike_for_the_same_order_and_seed_alone(
    one: Order, other: Order, seed: str, another: str
) -> None:
    receipt = receipt_for(one, seed)
    assert receipt == receipt_for(one, seed)
    assert len(receipt.id) == len(receipt.secret) == 22
    assert receipt.id != receipt.secret
    assert (receipt.id == receipt_for(other, another).id) is ((one, seed) == (other, another))
    assert (receipt.secret == receipt_for(other, seed).secret) is (one == other)


def test_events_go_by_ids_as_well(tmp_path: Path) -> None:
    jobs = durable_jobs(f"sqlite:///{tmp_path}/jobs.sqlite", Store(tmp_path))
    one, other = (jobs.submit(Order("0" * 64, "robot.zip")) for _ in range(2))
    jobs.cancel(other.id, other.secret)
    found = jobs.events({one.id: 0, other.id: 1, "unknown": 0, key_of_check(one.id): 0})
    assert {id: [event.stage.value for event in events] for id, events in found.items()} == {
        one.id: ["queued"],
        other.id: ["cancelled"],
    }
    assert jobs.events({}) == {}
    jobs.checks.engine.dispose()
