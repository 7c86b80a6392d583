"""A fault that goes on is written once, then how often a minute; no other fault is hidden."""

from __future__ import annotations

import io
import json
import logging
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from checker.service.jobs.port import JobsUnreachable, State
from checker.service.logs import FAULTS, LOGGER, REPEAT_SECONDS, JsonLines, Lines
from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from tests.web.board import ID, BoardJobs


class Written:
    """What a handler has written."""

    def __init__(self) -> None:
        self.stream = io.StringIO()
        self.handler = Lines(self.stream)
        self.handler.setFormatter(JsonLines())

    @property
    def lines(self) -> list[dict[str, Any]]:
        return [json.loads(line) for line in self.stream.getvalue().splitlines()]

    def log(
        self,
        at: float,
        message: str = "the database is away",
        level: int = logging.WARNING,
        error: Exception | None = None,
    ) -> None:
        """Log something at a moment."""
        trace = (type(error), error, error.__traceback__) if error else None
        record = logging.LogRecord(LOGGER, level, "", 0, message, None, trace)  # type: ignore[arg-type]
        record.created = at
        self.handler.handle(record)


@pytest.fixture
def written() -> Iterator[Written]:
    made = Written()
    yield made
    made.handler.close()


def raised(fail: Callable[[], object]) -> Exception:
    try:
        fail()
    except Exception as error:  # noqa: BLE001 - whatever it is
        return error
    raise AssertionError


class Away(BoardJobs):
    def status(self, id: str) -> State | None:
        raise JobsUnreachable(f"the database does not answer: {'no route ' * 9}, {len(id)}")


def test_a_database_that_is_away_fills_no_disk(tmp_path: Path, written: Written) -> None:
    logger = logging.getLogger(LOGGER)
    logger.addHandler(written.handler)
    try:
        client = TestClient(
            create_app(Away(), Store(tmp_path), Config()), base_url="http://localhost"
        )
        for _ in range(200):
            assert client.get(f"/api/checks/{ID}").status_code == 503
    finally:
        logger.removeHandler(written.handler)
    [first] = [line for line in written.lines if "trace" in line]
    assert "the database does not answer: no route" in first["message"]
    others = [line for line in written.lines if "trace" not in line]
    assert all(line["message"] == "request" for line in others)
    written.handler.close()
    assert written.lines[-1]["message"] == first["message"]
    assert written.lines[-1]["repeated"] == 199


def test_how_often_it_repeats_is_told_each_minute(written: Written) -> None:
    for second in range(int(2.5 * REPEAT_SECONDS)):
        written.log(1e9 + second)
    assert [line.get("repeated") for line in written.lines] == [None, 59, 60]
    written.handler.close()
    assert written.lines[-1]["repeated"] == 30


def test_it_is_told_by_whatever_comes_next(written: Written) -> None:
    written.log(1e9)
    written.log(1e9 + 1)
    written.log(1e9 + 2 * REPEAT_SECONDS, "request", logging.INFO)
    assert [line["message"] for line in written.lines][1:] == ["the database is away", "request"]
    assert written.lines[1]["repeated"] == 1


def test_one_that_comes_back_after_a_while_is_new(written: Written) -> None:
    for minute in range(4):
        written.log(1e9 + 2 * minute * REPEAT_SECONDS, error=raised(lambda: 1 / 0))
    assert ["trace" in line for line in written.lines] == [True] * 4


def test_no_other_fault_is_hidden(written: Written) -> None:
    def at_another_place() -> object:
        return 1 / 0

    faults = (
        {},
        {"message": "the disk is full"},
        {"level": logging.ERROR},
        {"error": raised(lambda: 1 / 0)},
        {"error": raised(at_another_place)},
        {"error": raised(lambda: {}["key"])},
    )
    for _ in range(3):
        for fault in faults:
            written.log(1e9, **fault)  # type: ignore[arg-type]
    assert len(written.lines) == len(faults)


def test_what_is_no_fault_is_written_each_time(written: Written) -> None:
    for _ in range(3):
        written.log(1e9, "request", logging.INFO)
    assert len(written.lines) == 3


def test_so_many_faults_are_known_and_no_more(written: Written) -> None:
    for number in range(FAULTS + 50):
        written.log(1e9, f"fault {number}")
    assert len(written.lines) == FAULTS + 50
    assert len(written.handler._known) == FAULTS
