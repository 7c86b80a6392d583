"""Logs of the web process and of workers: JSON lines on stderr, without tokens and ids.

An id opens a report; the key of a check, which identifies it too, opens none.
"""

from __future__ import annotations

import json
import logging
import sys
import time
import traceback
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TextIO

from checker.base.record import Record

LOGGER = "subt-check.web"
FIELDS = "fields"
"""Name of the extra of a record that contains what is in the line besides its message."""
REPEAT_SECONDS = 60.0
"""Seconds after which the number of repetitions of a fault is logged."""
FAULTS = 200
"""Known at once; further ones are written each time."""
_OURS = ("subt-check", "checker")
_OF_THE_SERVER = ("uvicorn", "uvicorn.error")
_WITH_ADDRESSES = "uvicorn.access"


class JsonLines(logging.Formatter):
    """A record as one line of ASCII: no text in it can start a new line."""

    def format(self, record: logging.LogRecord) -> str:
        """Return the line."""
        line: dict[str, object] = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
        }
        line |= getattr(record, FIELDS, {})
        if record.exc_info:
            line["trace"] = self.formatException(record.exc_info)
        return json.dumps(line, default=str)


class Fault(Record):
    """The key that two records of the same fault have in common.

    Attributes:
        where: Logger and level.
        words: What is stated about it.
        errors: Kinds of the exception and of those that caused it.
        raised: File and line that raised it.
    """

    where: tuple[str, int]
    words: str
    errors: tuple[str, ...] = ()
    raised: tuple[str, int] = ("", 0)


@dataclass
class Repeats:
    """A fault that continues.

    Attributes:
        record: The first of it, without its trace.
        since: Seconds since the epoch, from which repeats are counted.
        number: The number of repeats since then.
    """

    record: logging.LogRecord
    since: float
    number: int = 0


class Lines(logging.StreamHandler[TextIO]):
    """Writes records; a warning or error that repeats is written once, then how often a minute.

    A database that is away fails every request: each with its trace is megabytes a minute.
    """

    def __init__(self, stream: TextIO) -> None:
        super().__init__(stream)
        self._known: dict[Fault, Repeats] = {}

    def emit(self, record: logging.LogRecord) -> None:
        """Write a record unless it repeats one, and the due counts of others."""
        self._tell_repeats(record.created)
        if record.levelno < logging.WARNING:
            super().emit(record)
            return
        fault = _fault(record)
        if known := self._known.get(fault):
            known.number += 1
            return
        if len(self._known) < FAULTS:
            self._known[fault] = Repeats(_without_trace(record), record.created)
        super().emit(record)

    def close(self) -> None:
        """Log the repetitions that are not logged yet."""
        with suppress(ValueError):  # the reader may have ended before
            self._tell_repeats(float("inf"))
        super().close()

    def _tell_repeats(self, now: float) -> None:
        """Log the faults that are due; one that has ended is new when it occurs again."""
        due = [each for each in self._known.items() if now - each[1].since >= REPEAT_SECONDS]
        for fault, known in due:
            if not known.number:
                del self._known[fault]
                continue
            known.record.created = time.time()
            setattr(known.record, FIELDS, {"repeated": known.number})
            super().emit(known.record)
            known.since, known.number = now, 0


def _fault(record: logging.LogRecord) -> Fault:
    where, words = (record.name, record.levelno), record.getMessage()
    error = record.exc_info[1] if record.exc_info else None
    if error is None:
        return Fault(where, words)
    chain = [error]
    while cause := chain[-1].__cause__:
        chain.append(cause)
    kinds = tuple(type(each).__qualname__ for each in chain)
    *_, (frame, line) = traceback.walk_tb(error.__traceback__)
    return Fault(where, words, kinds, (frame.f_code.co_filename, line))


def _without_trace(record: logging.LogRecord) -> logging.LogRecord:
    """Return a copy without references to the program's state."""
    changes = {"msg": record.getMessage(), "args": (), "exc_info": None, "exc_text": None}
    return logging.makeLogRecord({**vars(record), **changes})


def log_to_stderr() -> None:
    """Log to stderr; the server's own log of addresses, which contain ids, is switched off."""
    handler = Lines(sys.stderr)
    handler.setFormatter(JsonLines())
    logging.basicConfig(level=logging.WARNING, handlers=[handler])
    for name in (*_OURS, *_OF_THE_SERVER):
        logger = logging.getLogger(name)
        logger.handlers = [] if name == "uvicorn.error" else [handler]
        logger.propagate = name == "uvicorn.error"
        logger.setLevel(logging.INFO)
    of_addresses = logging.getLogger(_WITH_ADDRESSES)
    of_addresses.handlers, of_addresses.propagate = [], False
