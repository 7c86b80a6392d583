"""Interface of a job engine for the service: eight calls; `durable` implements them."""

from __future__ import annotations

import enum
from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from msgspec import field

from checker.base.record import Record
from checker.base.sandbox.layers import Layer


class Stage(enum.StrEnum):
    """Stage of a check.

    It is `REFUSED` when the upload is at fault and its sender can correct that, and `FAILED` when
    the checker could not finish.
    """

    QUEUED = "queued"
    STATIC = "static"
    TRIAL = "trial"
    DONE = "done"
    REFUSED = "refused"
    FAILED = "failed"
    CANCELLED = "cancelled"

    @property
    def is_final(self) -> bool:
        """True if the state is final."""
        return self in (Stage.DONE, Stage.REFUSED, Stage.FAILED, Stage.CANCELLED)


class Order(Record):
    """A requested check.

    Attributes:
        upload: Hash (BLAKE3, hexadecimal) of the uploaded content in the store.
        name: The name of the uploaded file, made safe by `service.store.file_names`; its ending
            gives its kind.
        profile: The profile of the check; empty to detect it.
        sender: The sender, so that none of them keeps all others waiting; empty for anybody. It is
            not kept: a digest represents it that means nothing after the day.
    """

    upload: str
    name: str
    profile: str = ""
    sender: str = ""


class Receipt(Record):
    """The receipt of an order, for its sender alone.

    Attributes:
        id: The id of the check, unguessable; anyone who has it may read the report.
        secret: Ends and deletes the check; it does not follow from the id.
    """

    id: str
    secret: str


class State(Record):
    """State of a check.

    Attributes:
        id: The id of the check, unguessable.
        order: The order.
        stage: The current stage.
        words: The current activity or error, one sentence.
        ahead: Checks in front of it in the queue.
        created: Seconds since the epoch.
        result: Key of the stored report so far (static findings at first); empty before.
        packages: The data of each package so far: its "name", "verdict" (see `VerdictKind`),
            "kind", "errors", "warnings", "infos" and the "folder" of its files in the result (""
            for one).
        expires: Time at which everything of it is deleted, seconds since the epoch.
    """

    id: str
    order: Order
    stage: Stage
    words: str = ""
    ahead: int = 0
    created: float = 0.0
    result: str = ""
    packages: tuple[Mapping[str, Any], ...] = ()
    expires: float = 0.0


class Event(Record):
    """Something that happened to a check; numbers go up, from 1 at least."""

    number: int
    stage: Stage
    words: str
    time: float
    data: Mapping[str, Any] = field(default_factory=dict)


RETENTION_DAYS = 30
"""Default time after which all of a check is deleted."""
SILENCE_SECONDS = 60.0
"""Time after which a worker without a sign of life counts as dead."""


class JobsUnreachable(Exception):
    """The database does not answer; any of the calls may raise it."""


class Alive(Record):
    """State of the engine.

    Attributes:
        workers: Seconds since each worker's last sign of life, by its name.
        waiting: Checks that wait, by queue.
        running: Checks that run.
        layers: The layers of the sandbox around what each worker checks.
    """

    workers: Mapping[str, float]
    waiting: Mapping[str, int]
    running: int
    layers: Mapping[str, Sequence[Layer]] = field(default_factory=dict)

    @property
    def live_workers(self) -> Mapping[str, Sequence[Layer]]:
        """The workers that have not been silent for too long, with their layers."""
        return {
            name: self.layers.get(name, ())
            for name, seconds in self.workers.items()
            if seconds <= SILENCE_SECONDS
        }


class Jobs(Protocol):
    """The eight calls; none waits for a check, and all may be called from many threads."""

    def submit(self, order: Order, key: str = "") -> Receipt:
        """Take an order and return its receipt; once it returns, the order is not lost.

        Args:
            order: The requested check.
            key: A key of the client, unguessable. The same order with the same key gets the same
                receipt and is checked once. Empty: each order is a new one.
        """
        ...

    def status(self, id: str) -> State | None:
        """Return where a check stands; None for an id that was never given or is forgotten."""
        ...

    def events(self, after: Mapping[str, int]) -> Mapping[str, Sequence[Event]]:
        """Return what has happened to checks, in order, of each behind the number of an event.

        Args:
            after: Numbers by the ids of checks; 0 for all events. Those not known are left out.
        """
        ...

    def cancel(self, id: str, secret: str) -> bool:
        """End a check, unless it is over; False if the secret is not the one of this check."""
        ...

    def delete(self, id: str, secret: str) -> bool:
        """End a check and forget it at once; False if the secret is not the one of this check.

        Its files are deleted later, when no other check shares them.
        """
        ...

    def wait(self, client: str, per_minute: int) -> float:
        """Count an upload in all web processes, and return 0; or the seconds until one is allowed.

        Args:
            client: The client for whom it counts.
            per_minute: Uploads that a client may send, at least one.
        """
        ...

    def stage_seconds(self) -> Mapping[str, float]:
        """Return what each stage took lately, the median of some checks; those that are known."""
        ...

    def alive(self) -> Alive:
        """Return what is known of the engine.

        Raises:
            JobsUnreachable: The database does not answer.
        """
        ...
