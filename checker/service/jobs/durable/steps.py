"""What moves a check on: who takes it, what he has in hand, and what it comes to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from msgspec import field

from checker.base.record import Record
from checker.service.jobs.port import Order, Stage


class Taker(Record):
    """A worker process that takes checks.

    Attributes:
        name: No other one has it at the same time.
        host: Machine or container that it shares with others.
    """

    name: str
    host: str


class Held(Record):
    """A stage of a check in the hands of a worker.

    Attributes:
        id: Key of the check.
        worker: Its name.
        stage: What it does.
        order: What was asked for.
        is_last: Whether this is its last try, to be made alone.
    """

    id: str
    worker: str
    stage: Stage
    order: Order
    is_last: bool = False


class Step(Record):
    """What a check comes to.

    Attributes:
        key: Of the event that tells it: it is told once, however often the step is taken.
        stage: The new stage.
        words: What is going on or went wrong, one sentence.
        result: Key of the stored report, where there is a new one.
        packages: As in `State`, with a new result.
        data: Of the event.
    """

    key: str
    stage: Stage
    words: str
    result: str = ""
    packages: Sequence[Mapping[str, Any]] = ()
    data: Mapping[str, Any] = field(default_factory=dict)
