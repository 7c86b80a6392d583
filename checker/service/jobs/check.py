"""One stage of a check: an upload in the store becomes a result in the store, by a child process.

The worker reads no part of an upload: the child process opens it, and its answer
is not trusted either. The worker writes all that is kept, under its own names.
"""

from __future__ import annotations

import json
import logging
import secrets
import signal
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from itertools import chain, islice
from pathlib import Path
from shutil import disk_usage
from typing import Any

from msgspec import to_builtins

from checker.base.cache import key_of
from checker.base.child_process import from_json
from checker.base.files import NotReadable, make_folder, read_bytes
from checker.base.sandbox.files import Content, Files
from checker.base.sandbox.task import DISTURBED, FAULT_LIMIT, OUT_OF_MEMORY
from checker.base.words import plain
from checker.engine.report_cache import program_parts
from checker.report.files import ARTEFACT_NAME
from checker.service.jobs.children import ANSWER_LIMIT, Children, Ended
from checker.service.jobs.exchange import (
    CACHE,
    TRIAL_NICENESS,
    UPLOAD,
    StageLimits,
    is_part,
    read_summary,
)
from checker.service.jobs.outcome import (
    FAILED_INSIDE,
    UNFINISHED,
    Cancelled,
    Checked,
    Died,
    Disturbed,
    Outcome,
    Refused,
)
from checker.service.jobs.port import Order, Stage
from checker.service.store.store import RESULT_LIMIT, SUMMARY, Store

LIMITS: Mapping[Stage, StageLimits] = {
    Stage.STATIC: StageLimits(seconds=300.0),
    Stage.TRIAL: StageLimits(seconds=600.0),
}
UPLOAD_LIMIT = 2_000_000_000
"""Bytes of an upload that is read here; the service takes no larger ones."""
_FILES_LIMIT = 50_000
"""Greatest number of files of a result and its parts: empty files take room on a disk, too."""
_PARTS_LIMIT = 10_000
"""Greatest number for one upload, by all of its checks."""
_NAME_LIMIT = 255
"""Bytes of the name of a file or folder: no disk has longer ones."""
_ROOM = 10_000_000
"""Bytes of a disk below which it is full for a check."""
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
        store: Contains the upload, takes the result.
        children: One of them checks.
        order: What to check.
        stage: `STATIC` for the rules alone and the JSON report, `TRIAL` for all.
        cancelled: Whether to stop; called a few times a second.
        limits: The limits of the child; those of the stage when None.
    """
    try:
        known = stored_result(store, order, stage)
        return known or _checked(store, children, order, stage, cancelled, limits or LIMITS[stage])
    except OSError as error:
        _LOG.warning("the disk or the system failed", exc_info=True)
        return Disturbed(f"the system of the service says: {error.strerror or error}")


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
        return Refused("the upload no longer exists; upload the package again")
    request = {
        "name": order.name,
        "profile": order.profile,
        "stage": stage,
        "limits": to_builtins(limits),
    }
    content = read_bytes(upload, order.name, UPLOAD_LIMIT)
    if isinstance(content, NotReadable):
        return Disturbed(f"the stored upload {content.reason}")
    contents = chain(((UPLOAD, content),), _known_parts(store, order.upload))
    niceness = TRIAL_NICENESS if stage is Stage.TRIAL else 0
    with children.run_check(
        json.dumps(request).encode(), contents, limits.clock_seconds, cancelled, niceness
    ) as ended:
        if ended.cancelled:
            return Cancelled()
        return _outcome(store, order, result_key(order, stage), ended, limits)


def result_key(order: Order, stage: Stage) -> str:
    """Return the key of an order's result at a stage: of all that the result depends on."""
    return key_of(*program_parts(), order.upload, order.name, order.profile, stage)


def stored_result(store: Store, order: Order, stage: Stage) -> Checked | None:
    """Return the result of an order at a stage, if it is in the store and whole."""
    key = result_key(order, stage)
    path = store.file(key, SUMMARY) if store.has(key) else None
    return read_summary(key, _read(path)) if path else None


def _outcome(store: Store, order: Order, key: str, ended: Ended, limits: StageLimits) -> Outcome:
    match _parsed(ended.answer) if ended.code == 0 else None:
        case {"refused": str(reason)}:
            return Refused(plain(reason))
        case {"disturbed": str(reason)} if reason:
            return Disturbed(plain(reason))
        case {"crashed": bool(crashed)} as answer:
            # An internal error may not occur the next time: the result is not shared.
            checked = read_summary(secrets.token_hex(32) if crashed else key, answer)
            if checked is not None:
                return _kept(store, order, checked, ended)
    last_words = repr(ended.answer[-FAULT_LIMIT:].decode(errors="replace"))
    how = "overdue" if ended.overdue else ended.exceeded or f"code {ended.code}"
    _LOG.error("the child process ended (%s) with the output: %s", how, last_words)
    failed = failure(ended, limits)
    # Libraries have words of their own for a disk that is full.
    if failed == Died(FAILED_INSIDE) and disk_usage(store.folder).free < _ROOM:
        return Disturbed("the disk of the service is full")
    return failed


def _kept(store: Store, order: Order, checked: Checked, ended: Ended) -> Outcome:
    """Put a result into the store: files that we write, under names that we know."""
    with store.workplace() as place:
        try:
            folder = place / "made"
            _write_result(folder, ended.files)
            (folder / SUMMARY).write_bytes(ended.answer)
            store.keep(checked.key, folder)
        except ValueError as error:
            _LOG.error("the child process made an invalid result: %s", plain(str(error)))
            return Died(f"{UNFINISHED}: its report is too large or damaged")
        # Without them, the next check takes longer.
        with suppress(OSError):
            _keep_parts(store, order.upload, ended.files, place / "parts")
    return checked


def _write_result(folder: Path, files: Files) -> None:
    """Write the files of a result.

    Raises:
        ValueError: The process that made them had no reason to make these.
    """
    if len(files.names) > _FILES_LIMIT:
        raise ValueError(f"a result has at most {_FILES_LIMIT} files")
    folder.mkdir()
    left = RESULT_LIMIT
    for name in files.names:
        left -= files.size(name)
        if left < 0:
            raise ValueError(f"a result has at most {RESULT_LIMIT / 1e9:g} GB")
        longest = max(len(part.encode()) for part in name.split("/"))
        if ARTEFACT_NAME.fullmatch(name) and longest <= _NAME_LIMIT:
            path = folder / name
            path.parent.mkdir(exist_ok=True)
            with path.open("xb") as file:
                files.copy(name, file)
        elif not is_part(name):
            raise ValueError(f"{name[:200]!r} is not a file of a result")


def _known_parts(store: Store, upload: str) -> Iterator[tuple[str, Content]]:
    """Yield what was computed in an earlier check of the same upload: of no other one."""
    folder = store.parts(upload)
    if folder is not None:
        for path in sorted(folder.glob(f"{CACHE}/*/??/*.json")):
            name = path.relative_to(folder).as_posix()
            yield name, read_bytes(path, name, RESULT_LIMIT)


def _keep_parts(store: Store, upload: str, files: Files, folder: Path) -> None:
    """Keep what a check has computed, for later checks of the same upload alone."""
    known = store.parts(upload)
    left = _PARTS_LIMIT - (sum(1 for _ in known.rglob("*.json")) if known else 0)
    for name in islice(filter(is_part, files.names), max(0, left)):
        make_folder((folder / name).parent)
        with (folder / name).open("wb") as file:
            files.copy(name, file)
    store.add_parts(upload, folder)


def _read(path: Path) -> Any:
    """Return the JSON in a file of a result; None if there is none."""
    data = read_bytes(path, path.name, ANSWER_LIMIT)
    return None if isinstance(data, NotReadable) else _parsed(data)


def _parsed(data: bytes) -> Any:
    try:
        return from_json(data)
    except ValueError:
        return None


def failure(ended: Ended, limits: StageLimits) -> Died | Disturbed:
    """Return what has ended a process: its own work, or a signal from outside."""
    if ended.overdue:
        return Disturbed(f"the service had no time for it within {limits.clock_seconds:g} s")
    if ended.exceeded:
        return _needs_more(ended.exceeded)
    if ended.code in _FROM_OUTSIDE:
        return Disturbed(_FROM_OUTSIDE[ended.code])
    too_much = {
        -signal.SIGXCPU: f"{limits.seconds:g} s of processor time",
        OUT_OF_MEMORY: f"{limits.memory / 1e9:g} GB of memory",
    }
    if ended.code in too_much:
        return _needs_more(too_much[ended.code])
    return Died(FAILED_INSIDE)


def _needs_more(than: str) -> Died:
    return Died(f"{UNFINISHED}: it needs more than {than}; check fewer packages at a time")


_FROM_OUTSIDE: Mapping[int | None, str] = {
    None: "its process could not be started, or was ended with all others",
    DISTURBED: "the disk or the system of the service failed",
    **{
        -number: f"its process was killed ({number.name})"
        for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGHUP, signal.SIGINT)
    },
}
"""Ends of a process that its own work does not lead to, by exit code; limits have other signals."""
