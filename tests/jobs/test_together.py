"""Changes of several threads in one transaction: all hold that can, and each learns its own end."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event

import pytest
import sqlalchemy as sa

from checker.service.jobs.durable.database import open_database
from checker.service.jobs.durable.together import Together
from tests.web.server import eventually

NUMBERS = sa.Table("numbers", sa.MetaData(), sa.Column("number", sa.Integer, primary_key=True))


@pytest.fixture
def engine(tmp_path: Path) -> Iterator[sa.Engine]:
    engine = open_database(f"sqlite:///{tmp_path}/numbers.sqlite")
    NUMBERS.metadata.create_all(engine)
    yield engine
    engine.dispose()


def written(engine: sa.Engine) -> list[int]:
    with engine.connect() as connection:
        return list(connection.scalars(sa.select(NUMBERS.c.number).order_by(NUMBERS.c.number)))


class Book:
    """Writes numbers, in few transactions; the first one waits until `go`."""

    def __init__(self, engine: sa.Engine) -> None:
        self.together, self.begun, self.go = Together(engine), Event(), Event()
        self.transactions = 0
        sa.event.listen(engine, "commit", self._count)

    def _count(self, _: sa.Connection) -> None:
        self.transactions += 1

    def enter(self, number: int, wait: bool = False) -> None:
        def change(connection: sa.Connection) -> None:
            if wait:
                self.begun.set()
                assert self.go.wait(20)
            connection.execute(sa.insert(NUMBERS).values(number=number))

        self.together.make(change)

    def enter_all(self, numbers: list[int]) -> list[BaseException | None]:
        """Enter numbers while a first one, 0, is being entered; return what each came to."""
        with ThreadPoolExecutor(len(numbers) + 1) as pool:
            first = pool.submit(self.enter, 0, wait=True)
            assert self.begun.wait(20)
            others = [pool.submit(self.enter, number) for number in numbers]
            assert eventually(lambda: len(self.together._waiting) == len(numbers))
            self.go.set()
            first.result()
            return [each.exception() for each in others]


def test_those_who_wait_share_a_transaction(engine: sa.Engine) -> None:
    book = Book(engine)
    assert book.enter_all([*range(1, 9)]) == [None] * 8
    assert written(engine) == [*range(9)]
    assert book.transactions == 2


def test_one_that_fails_takes_no_other_with_it(engine: sa.Engine) -> None:
    book = Book(engine)
    failures = book.enter_all([1, 2, 2, 3, 0])
    assert written(engine) == [0, 1, 2, 3]
    assert sum(failure is None for failure in failures) == 3
    assert all(isinstance(each, sa.exc.IntegrityError) for each in failures if each is not None)


def test_many_at_once(engine: sa.Engine) -> None:
    book = Book(engine)
    with ThreadPoolExecutor(16) as pool:
        list(pool.map(book.enter, range(200)))
    assert written(engine) == [*range(200)]


def test_after_a_failure_all_goes_on(engine: sa.Engine) -> None:
    book = Book(engine)
    book.enter(1)
    for _ in range(2):
        with pytest.raises(sa.exc.IntegrityError):
            book.enter(1)
    book.enter(2)
    assert written(engine) == [1, 2]


def test_a_database_that_is_away_is_asked_once_for_all_who_wait(engine: sa.Engine) -> None:
    book, tries = Book(engine), []

    def away(_: sa.Connection) -> None:
        tries.append(1)
        raise sa.exc.OperationalError("", None, Exception("it does not answer"))

    with ThreadPoolExecutor(5) as pool:
        first = pool.submit(book.enter, 0, wait=True)
        assert book.begun.wait(20)
        others = [pool.submit(book.together.make, away) for _ in range(4)]
        assert eventually(lambda: len(book.together._waiting) == 4)
        book.go.set()
        first.result()
        assert all(isinstance(each.exception(), sa.exc.OperationalError) for each in others)
    assert tries == [1]
