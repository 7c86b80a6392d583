"""A worker whose stages take a fixed time: `python -m tests.survival.steady_worker`.

Argument: the file in which it notes each stage that it begins. The rest is in the environment, as
for `subt-check worker`.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from time import sleep

from checker.service.jobs.checking import result_key
from checker.service.jobs.children import Children
from checker.service.jobs.durable import stages
from checker.service.jobs.durable.worker import WorkerOptions, work
from checker.service.jobs.outcome import Checked, Outcome
from checker.service.jobs.place import database_url
from checker.service.jobs.port import Order, Stage
from checker.service.store.place import data_folder
from checker.service.store.store import Store
from tests.jobs.quick_worker import PACKAGE, WORDS, keep

SECONDS = {Stage.STATIC: 0.3, Stage.TRIAL: 0.8}
SILENCE_SECONDS = 3.0


def steady_check(
    log: Path,
    store: Store,
    _children: Children,
    order: Order,
    stage: Stage,
    _cancelled: Callable[[], bool],
) -> Outcome:
    """Stand for `check_upload`."""
    key = result_key(order, stage)
    if not store.has(key):
        with log.open("a") as file:
            file.write(f"{stage} {order.name}\n")
        sleep(SECONDS[stage])
        keep(store, key)
    return Checked(key, (PACKAGE,), WORDS)


def main() -> None:
    stages.check_upload = partial(steady_check, Path(sys.argv[1]))
    store = Store(data_folder())
    quick = {"beat_seconds": 0.2, "silence_seconds": SILENCE_SECONDS}
    work(WorkerOptions(database_url(), store, ahead=False, **quick))


if __name__ == "__main__":
    main()
