"""Checks wait while a crowd uploads, and for no longer than that or than said."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from time import monotonic

import pytest

from checker.service.jobs.crowd import let_pass
from checker.service.store.store import Store

CROWD = 8


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "data")


@pytest.fixture
def uploads() -> Iterator[ExitStack]:
    with ExitStack() as stack:
        yield stack


def looks(store: Store, uploads: ExitStack, seconds: float = 600.0, most: int = 3) -> int:
    """Return how often it is asked whether a check is wanted; `uploads` end at the last time."""
    asked = 0

    def cancelled() -> bool:
        nonlocal asked
        asked += 1
        if asked == most:
            uploads.close()
        return False

    let_pass(store, cancelled, seconds)
    return asked


def come(store: Store, uploads: ExitStack, number: int) -> None:
    for _ in range(number):
        uploads.enter_context(store.incoming()).write(b"robot")


def test_a_few_uploads_are_not_waited_for(store: Store, uploads: ExitStack) -> None:
    assert looks(store, uploads) == 0
    come(store, uploads, CROWD - 1)
    assert looks(store, uploads) == 0


def test_a_crowd_is_waited_for_until_it_has_passed(store: Store, uploads: ExitStack) -> None:
    come(store, uploads, CROWD)
    assert looks(store, uploads) == 3
    assert store.coming() == 0


def test_an_upload_that_is_kept_is_none_that_comes(store: Store, uploads: ExitStack) -> None:
    come(store, uploads, CROWD - 1)
    with store.incoming() as last:
        assert store.coming() == CROWD
        last.write(b"last")
        last.finish()
        assert store.coming() == CROWD - 1


def test_a_crowd_that_never_passes(store: Store, uploads: ExitStack) -> None:
    come(store, uploads, CROWD)
    begun = monotonic()
    assert looks(store, uploads, seconds=0.2, most=1_000) > 0
    assert 0.2 <= monotonic() - begun < 20
    assert store.coming() == CROWD


def test_a_check_that_nobody_wants_any_more_does_not_wait(store: Store, uploads: ExitStack) -> None:
    come(store, uploads, CROWD)
    let_pass(store, lambda: True, seconds=600.0)
    assert store.coming() == CROWD
