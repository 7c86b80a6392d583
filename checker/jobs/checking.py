"""One stage of a check: an upload in the store becomes a result in the store, by a child process.

Nothing of an upload is read in the worker: the child opens it, and what it brings back counts as
a stranger's too.
"""

from __future__ import annotations

import json
import logging
import os
import secrets
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from checker.cache import key_of
from checker.jobs.children import Children
from checker.jobs.crowd import let_pass
from checker.jobs.isolation import StageLimits
from checker.jobs.layout import ANSWER, MADE, OUT_OF_MEMORY, SAID, lay_out
from checker.jobs.outcome import (
    FAILED_INSIDE,
    UNFINISHED,
    Cancelled,
    Checked,
    Died,
    Outcome,
    Refused,
)
from checker.jobs.port import Order, Stage
from checker.jobs.summary import read_summary
from checker.jobs.supervised import Ended
from checker.package.reading import NotReadable, open_file, read_bytes
from checker.recall import program_parts
from checker.report.wording import plain
from checker.store.store import SUMMARY, Store

LIMITS: Mapping[Stage, StageLimits] = {
    Stage.STATIC: StageLimits(seconds=300.0),
    Stage.TRIAL: StageLimits(seconds=900.0),
}
_ANSWER_LIMIT = 5_000_000
_SHOWN = 4_000
"""Bytes of what a dead child has said, for the log."""
_LOG = logging.getLogger(__name__)


def check_upload(
    store: Store,
    children: Children,
    order: Order,
    stage: Stage,
    cancelled: Callable[[], bool],
    limits: StageLimits | None = None,
) -> Outcome:
    """Check an upload; a result that is in the store already is not made again.

    Args:
        store: Holds the upload, takes the result.
        children: One of them checks.
        order: What to check.
        stage: `STATIC` for the rules alone and the JSON report, `TRIAL` for all.
        cancelled: Whether to stop; asked a few times a second.
        limits: Of the child; those of the stage when None.
    """
    try:
        known = stored_result(store, order, stage)
        return known or _checked(store, children, order, stage, cancelled, limits or LIMITS[stage])
    except OSError as error:
        _LOG.exception("the disk or the system failed")
        return Died(f"{UNFINISHED}: {error.strerror or 'the system failed'}")


def _checked(
    store: Store,
    children: Children,
    order: Order,
    stage: Stage,
    cancelled: Callable[[], bool],
    limits: StageLimits,
) -> Outcome:
    upload = store.upload(order.upload)
    if upload is None:
        return Refused("the upload is no longer there; upload it again")
    with store.workplace() as place:
        lay_out(place, upload, order, stage, limits)
        let_pass(store, cancelled)
        ended = children.check(place, limits.seconds, cancelled)
        if ended.cancelled:
            return Cancelled()
        return _outcome(store, result_key(order, stage), place, ended, limits)


def result_key(order: Order, stage: Stage) -> str:
    """Return the key of an order's result at a stage: of all that the result depends on."""
    return key_of(*program_parts(), order.upload, order.name, order.profile, stage)


def stored_result(store: Store, order: Order, stage: Stage) -> Checked | None:
    """Return the result of an order at a stage, if it is in the store and whole."""
    key = result_key(order, stage)
    path = store.file(key, SUMMARY) if store.has(key) else None
    return read_summary(key, _read(path)) if path else None


def _outcome(store: Store, key: str, place: Path, ended: Ended, limits: StageLimits) -> Outcome:
    answer = _read(place / ANSWER) if ended.code == 0 and not ended.overdue else None
    match answer:
        case {"refused": str(reason)}:
            return Refused(plain(reason))
        case {"crashed": bool(crashed)}:
            # What went wrong with us may go right the next time: nobody else gets this result.
            checked = read_summary(secrets.token_hex(32) if crashed else key, answer)
            if checked is not None:
                return _kept(store, checked, place)
    _LOG.error("the child ended with %s and said: %s", ended, _last_words(place / SAID))
    return Died(_cause(ended, limits))


def _kept(store: Store, checked: Checked, place: Path) -> Outcome:
    """Put a result into the store."""
    (place / ANSWER).rename(place / MADE / SUMMARY)
    try:
        store.keep(checked.key, place / MADE)
    except ValueError as error:
        _LOG.error("the child made what is no result: %s", plain(str(error)))
        return Died(f"{UNFINISHED}: its report is too large or damaged")
    return checked


def _read(path: Path) -> Any:
    """Return the JSON that the child has written; None if there is none."""
    data = read_bytes(path, path.name, _ANSWER_LIMIT)
    try:
        return None if isinstance(data, NotReadable) else json.loads(data)
    except (ValueError, RecursionError):
        return None


def _cause(ended: Ended, limits: StageLimits) -> str:
    if ended.overdue:
        advice = "check fewer packages at a time"
        return f"{UNFINISHED}: it took longer than {limits.seconds:g} s and was stopped; {advice}"
    if ended.code < 0:
        return f"{UNFINISHED}: it was killed; it may have needed too much time or memory"
    if ended.code == OUT_OF_MEMORY:
        return f"{UNFINISHED}: it needed more than {limits.memory / 1e9:g} GB of memory"
    return FAILED_INSIDE


def _last_words(said: Path) -> str:
    """Return the end of what the child has said, on one line of a log."""
    # The child may have put a link or a pipe in its place, which would have us wait.
    try:
        with open_file(said) as file:
            file.seek(max(0, os.fstat(file.fileno()).st_size - _SHOWN))
            return repr(file.read(_SHOWN).decode(errors="replace"))
    except OSError as error:
        return f"nothing that can be read: {error.strerror}"
