"""A worker whose checks take as long as their profile says: `python -m tests.jobs.quick_worker`.

Arguments: the fields of `WorkerOptions` as JSON, `store` as a folder, and the file of the log.
Profiles: `static:2` and `trial:2` take two seconds, `kill:static` and `kill:trial` kill the worker,
`refused`, `died` and `raises` come out so at once, `warns` has DBOS warn, and
`full:static:2` finds a full disk two times, and `hangs:trial:1` hangs once, until it is killed.
`static:1 trial:2` is both.
"""

from __future__ import annotations

import json
import logging
import os
import signal
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from time import monotonic, sleep
from typing import Any

from checker.service.jobs.check import result_key
from checker.service.jobs.children import Children
from checker.service.jobs.durable import stages
from checker.service.jobs.durable.tasks import TRIES
from checker.service.jobs.durable.worker import WorkerOptions, work
from checker.service.jobs.outcome import Cancelled, Checked, Died, Disturbed, Outcome, Refused
from checker.service.jobs.port import Order, Stage
from checker.service.store.store import SUMMARY, Store

PACKAGE = {
    "name": "quick",
    "verdict": "ready",
    "errors": 0,
    "warnings": 1,
    "infos": 2,
    "folder": "",
    "kind": "robot",
}
WORDS = "Ready: no error"
REFUSAL = "robot.zip is not an archive"
DEATH = "the checker could not finish: it needs more than 4 GB of memory"
FULL = "the system of the service says: No space left on device"
PAUSES = (0.05,) * (TRIES - 1)


def quick_check(
    log: Path,
    store: Store,
    _children: Children,
    order: Order,
    stage: Stage,
    cancelled: Callable[[], bool],
) -> Outcome:
    """Stand for `check_upload`: as long, as deadly and as repeatable, without a robot."""
    key = result_key(order, stage)
    if not store.has(key):
        _note(log, f"{stage} {order.name} {os.getpid()}")
        for part in order.profile.split():
            what, _, detail = part.partition(":")
            if what == "kill" and detail == stage:
                os.kill(os.getpid(), signal.SIGKILL)
            if what == "warns":
                logging.getLogger("dbos").warning("as DBOS would")
            if what == "raises":
                raise RuntimeError("as a fault of ours would")
            if what == "full" and _is_among_first(log, detail, f"{stage} {order.name} "):
                return Disturbed(FULL)
            if what == "hangs" and _is_among_first(log, detail, f"{stage} {order.name} "):
                sleep(3600)
            if what in ("refused", "died"):
                return Refused(REFUSAL) if what == "refused" else Died(DEATH)
            if what == stage and not _passed(float(detail), cancelled):
                _note(log, f"stopped-{stage} {order.name} {os.getpid()}")
                return Cancelled()
        keep(store, key)
    return Checked(key, (PACKAGE,), WORDS)


def keep(store: Store, key: str) -> None:
    """Put a small result into the store."""
    with store.workplace() as place:
        made = place / "made"
        made.mkdir()
        (made / "report.json").write_text("{}")
        (made / SUMMARY).write_text(json.dumps({"packages": [PACKAGE], "words": WORDS}))
        store.keep(key, made)


def _note(log: Path, line: str) -> None:
    with log.open("a") as file:
        file.write(line + "\n")


def _is_among_first(log: Path, detail: str, line: str) -> bool:
    """Whether this try is among the first, as many as a profile says of a stage: `static:2`."""
    stage, _, tries = detail.partition(":")
    return line.startswith(stage) and log.read_text().count(line) <= int(tries)


def _passed(seconds: float, cancelled: Callable[[], bool]) -> bool:
    deadline = monotonic() + seconds
    while monotonic() < deadline:
        if cancelled():
            return False
        sleep(0.05)
    return True


def main() -> None:
    options: dict[str, Any] = json.loads(sys.argv[1])
    stages.check_upload = partial(quick_check, Path(sys.argv[2]))
    work(
        WorkerOptions(
            **options | {"store": Store(Path(options["store"])), "ahead": False, "pauses": PAUSES}
        )
    )


if __name__ == "__main__":
    main()
